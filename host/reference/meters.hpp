// The reference engine's own observables, written from their definitions in plain double, to be
// compared with those of the kernels.
#pragma once

#include <memory>
#include <vector>

#include "reference/trajectory.hpp"
#include "study/selection.hpp"

namespace gearsweep {

// Measures one trajectory over its recorded periods.
class Meter {
 public:
  virtual ~Meter() = default;
  virtual void step(const Moment& before, const Moment& after, double share) = 0;
  // The observable's outputs, in its order.
  virtual std::vector<double> finish(std::size_t periods) const = 0;
};

// Throws RunError for an observable that the reference engine does not know.
std::unique_ptr<Meter> make_meter(const Model& model, const Observer& observer);

}  // namespace gearsweep
