#include "cli/detail/digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

constexpr double kMaxDigits = 10.0;
constexpr double kMinWhole = -3.0;  // a number with more zeros behind its point has an exponent

}  // namespace

std::string with_digits(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error)) return "?";
  double decimals = error > 0.0 ? std::floor(-std::log10(2.0 * error)) : kMaxDigits;
  if (value != 0.0) {
    const double whole = std::floor(std::log10(std::fabs(value))) + 1.0;
    const double digits = std::min(whole + decimals, kMaxDigits);
    if (decimals <= 0.0 && digits <= 0.0) return "?";
    if (digits > 0.0 && (whole < kMinWhole || whole > kMaxDigits)) {
      return fmt::format("{:.{}e}", value, static_cast<int>(digits) - 1);
    }
    decimals = std::min(decimals, kMaxDigits - whole);
  }
  decimals = std::min(decimals, kMaxDigits - kMinWhole);
  const double unit = std::pow(10.0, -decimals);
  const double rounded = std::round(value / unit) * unit;
  // No sign of a zero.
  return fmt::format("{:.{}f}", rounded == 0.0 ? 0.0 : rounded,
                     static_cast<int>(std::max(0.0, decimals)));
}

}  // namespace gearsweep
