// Values of motion_class.
#pragma once

namespace gearsweep::testing {

inline constexpr double kUndecided = 0.0, kPeriodic = 1.0, kQuasiPeriodic = 2.0, kChaotic = 3.0;

}  // namespace gearsweep::testing
