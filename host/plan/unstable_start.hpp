// Points that start at an unstable equilibrium of an autonomous model. There they rest until
// what rounding leaves has grown: a map shows the one, the other, or something between.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "plan/plan.hpp"

namespace gearsweep {

class UnstableStarts {
 public:
  // The plan outlives it.
  explicit UnstableStarts(const Plan& plan) : plan_(plan) {}

  // Whether a point is one that starts at this state of the plan's model: its field vanishes to
  // rounding, and an eigenvalue of its Jacobian has a positive real part. Both hold in any units.
  bool has(std::size_t point, const std::vector<double>& start);

 private:
  bool is_autonomous();

  const Plan& plan_;
  std::optional<bool> is_autonomous_;
};

}  // namespace gearsweep
