// A file of curves that nobody searched for: a linear oscillator has its orbits in closed form, and
// the file says of some of them that they bifurcate.
#pragma once

#include <complex>
#include <string>

#include "support/folder.hpp"

namespace gearsweep::testing {

inline constexpr double kLinearDamping = 0.2;
inline const std::string kLinear =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.2\nlinear = 1.0\ncubic = 0.0\n"
    "[[axes]]\nname = 'omega'\nfrom = 0.8\nto = 1.6\ncount = 20\n"
    "[[axes]]\nname = 'amplitude'\nfrom = 0.1\nto = 0.4\ncount = 10\nscale = 'log'\n"
    "[integrate]\nsettle = 30\nrecord = 8\n[observe]\nquantities = ['x_max', 'period']\n";

// x'' + d x' + x = A sin(omega t) swings as Im(response e^(i omega t)).
inline std::complex<double> response(double omega, double amplitude) {
  return amplitude / std::complex<double>(1.0 - omega * omega, kLinearDamping * omega);
}

// What multiplies e^(i omega t) after a period.
std::complex<double> linear_multiplier(double omega);

// What makes the file another one than it should be.
enum class Damage { none, no_place, no_state, no_period, no_curves };

// A fold of period 1 at amplitude 0.2 and omega = 0.9, 1, 1.1, 1.2, 1.3, of which other multipliers
// make the last two points unstable, with residuals of 1e-12 omega; and a Neimark-Sacker curve of
// period 2 at omega = 1.4 and amplitude = 0.15, 0.3, of whose last point a multiplier is not known.
// Returns its path.
std::string write_linear_curves(const Folder& folder, Damage damage = Damage::none);

}  // namespace gearsweep::testing
