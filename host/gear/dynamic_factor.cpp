#include "gear/dynamic_factor.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace gearsweep {
namespace {

// Table 5 of the standard; what does not depend on the contact ratio first.
constexpr double kCv1 = 0.32, kCv5 = 0.47;
struct Cv {
  double c2, c3, c4, c6, c7;
};

Cv cv_of(double contact_ratio) {
  const double eps = contact_ratio;
  Cv out{0.34, 0.23, 0.90, 0.47, 1.0};
  if (eps > 2.0) {
    out = {0.57 / (eps - 0.3), 0.096 / (eps - 1.56), (0.57 - 0.05 * eps) / (eps - 1.44),
           0.12 / (eps - 1.74), 1.0};
  }
  if (eps <= 1.5) {
    out.c7 = 0.75;
  } else if (eps <= 2.5) {
    out.c7 = 0.125 * std::sin(std::numbers::pi * (eps - 2.0)) + 0.875;
  }
  return out;
}

}  // namespace

double run_in_deviation(double deviation) { return deviation - std::fmin(0.075 * deviation, 3.0); }

double dynamic_factor(const DynamicFactorInput& pair, double line_load, double resonance_ratio) {
  if (!(line_load > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kMain = 1.15, kHigh = 1.5;  // ends of the main resonance and of what is between
  const double lowest =
      line_load < 100.0 ? 0.5 + 0.35 * std::sqrt(line_load / 100.0) : 0.85;  // N_S
  const double per_um = pair.single_stiffness / line_load;
  const double pitch = per_um * run_in_deviation(pair.pitch_deviation);
  const double profile = per_um * run_in_deviation(pair.profile_deviation);
  const double relief = pair.tip_relief ? std::fabs(1.0 - per_um * *pair.tip_relief) : 1.0;
  const Cv cv = cv_of(pair.contact_ratio);
  const double errors = kCv1 * pitch + cv.c2 * profile;
  const double in_resonance = 1.0 + errors + cv.c4 * relief;
  const double above = kCv5 * pitch + cv.c6 * profile + cv.c7;
  const double ratio = resonance_ratio;
  if (ratio <= lowest) return 1.0 + ratio * (errors + cv.c3 * relief);
  if (ratio <= kMain) return in_resonance;
  if (ratio >= kHigh) return above;
  return above + (in_resonance - above) * (kHigh - ratio) / (kHigh - kMain);
}

}  // namespace gearsweep
