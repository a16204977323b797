// What a Runge-Kutta step misses when a limit of the backlash is crossed inside it: the reference
// engine's own version of kernels/rk4/crossing.h, which explains the correction.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace gearsweep {

// With p the deflection beyond a flank's limit at the step's four evaluations, the true force's
// integral over the step and its first moment about the step's end, in units of the step, are those
// of the evaluations plus these combinations of p. They hold for the derivatives of p, too.
struct CrossingWeights {
  Eigen::Vector4d sum, moment;
};

// Nothing when the limit is not crossed between what the first and the last evaluation saw; p: what
// they would have seen on the smooth continuation of the motion. `flank` is 1 for the drive flank
// (p = D - b', in contact when positive), -1 for the back flank (p = D + b', in contact when
// negative).
std::optional<CrossingWeights> crossing_weights(const Eigen::Vector4d& seen,
                                                const Eigen::Vector4d& p, double flank);

// The matrix that makes that p of what was seen; feedback: how much a unit of p changes p within
// the step.
Eigen::Matrix4d crossing_feedback(const Eigen::Vector4d& seen, double flank, double feedback);

}  // namespace gearsweep
