#include "verify/compared.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace gearsweep {

bool Compared::holds() const { return share_of_tolerance() <= 1.0; }

double Compared::share_of_tolerance() const {
  if (expected == seen || (std::isnan(expected) && std::isnan(seen))) return 0.0;
  const double quotient = std::abs(seen - expected) / tolerance;
  return std::isnan(quotient) ? std::numeric_limits<double>::infinity() : quotient;
}

std::string describe(const Compared& compared) {
  const std::string limit = compared.tolerance > 0.0
                                ? fmt::format("tolerance {:.2g}", compared.tolerance)
                                : std::string("the same number is needed");
  return fmt::format("{}: expected {}, seen {} ({})", compared.what, compared.expected,
                     compared.seen, limit);
}

}  // namespace gearsweep
