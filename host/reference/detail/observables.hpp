// The reference engine's own observables, written from their definitions in plain double, to be
// compared with those of the kernels.
#pragma once

#include <memory>
#include <vector>

#include "engine/window.hpp"
#include "reference/detail/trajectory.hpp"
#include "study/selection.hpp"

namespace gearsweep {

// Measures one trajectory over its recorded periods.
class ReferenceObservable {
 public:
  virtual ~ReferenceObservable() = default;
  // Before anything else: the state at phase 0 where the record begins.
  virtual void begin(const Eigen::VectorXd&) {}
  virtual void step(const TrajectoryStep&) {}
  // One period: the state at its end; the logarithms of how far its orthonormal tangent vectors
  // grew (empty unless the selection has some); its length in dimensionless time.
  virtual void period(const Eigen::VectorXd&, const Eigen::VectorXd&, double) {}
  // The observable's outputs, in its order, once the window is recorded.
  virtual std::vector<double> finish(const Window& window) const = 0;
};

// `setting`: of the point. Throws RunError for an observable that the reference engine does not
// know.
std::unique_ptr<ReferenceObservable> make_observable(const Study& study,
                                                     const ModelSetting& setting,
                                                     const Observer& observer);

}  // namespace gearsweep
