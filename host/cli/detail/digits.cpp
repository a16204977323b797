#include "cli/detail/digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

constexpr double kMaxDigits = 10.0;

}  // namespace

std::string with_digits(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error)) return "?";
  double decimals = error > 0.0 ? std::floor(-std::log10(2.0 * error)) : kMaxDigits;
  if (value != 0.0) {
    const double whole = std::floor(std::log10(std::fabs(value))) + 1.0;
    if (decimals <= 0.0 && whole + decimals <= 0.0) return "?";
    decimals = std::min(decimals, kMaxDigits - whole);
  }
  const double unit = std::pow(10.0, -decimals);
  const double rounded = std::round(value / unit) * unit;
  // No sign of a zero.
  return fmt::format("{:.{}f}", rounded == 0.0 ? 0.0 : rounded,
                     static_cast<int>(std::max(0.0, decimals)));
}

}  // namespace gearsweep
