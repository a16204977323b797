// A load spectrum: loads and speeds, each with the share of time that it lasts.
#pragma once

#include <vector>

namespace gearsweep {

// The column of a list of points that makes it one.
inline constexpr const char* kTimeShare = "time_share";

// The slope of the damage line by which Miner's rule counts loads, a torque to this power times its
// cycles:
// ISO 6336-6, Table A.1, pitting of case-hardened and of through-hardened steel.
inline constexpr double kUsualSlope = 6.61;

struct LoadSpectrum {
  std::vector<double> shares;  // of the time, [point]; their sum is 1
  double slope = kUsualSlope;
};

}  // namespace gearsweep
