// Which state enters whose derivative, and what the states are like that a reduced model leaves
// out.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// Found at the given settings from derivatives at random states and phases, of all sizes from well
// inside a backlash to far beyond it. What a contact adds counts whether teeth touch there or not.
class Structure {
 public:
  // Both outlive it.
  Structure(const Model& model, const std::vector<ModelSetting>& settings);

  // The states that a signal depends on.
  std::set<std::size_t> drivers_of_signal(std::size_t signal) const;
  // These states and all that drive them.
  std::set<std::size_t> closure(std::set<std::size_t> states) const;
  // Whether what is left out follows linear equations whose coefficients do not change in time, and
  // whether mirrored states do mirror each other.
  bool leaves_constant_block(const Reduction& reduction) const;

 private:
  void look(const PreparedPoint& point, const std::vector<double>& coefs,
            const std::vector<double>& x);
  void look_at_contact(const PreparedPoint& point, const std::vector<double>& coefs,
                       const std::vector<double>& x);

  const Model& model_;
  const std::vector<ModelSetting>& settings_;
  std::vector<std::set<std::size_t>> drivers_;         // [state]
  std::vector<std::set<std::size_t>> signal_drivers_;  // [signal]
  std::set<std::size_t> contact_drivers_;
};

// The matrix, in column-major order, by which what a reduced model leaves out changes: passive
// states, then the sums x[first] + x[second] of mirrored ones.
std::vector<double> left_out_block(const Model& reduced, const ModelSetting& setting);

}  // namespace gearsweep
