#include "sweep/detail/share_bound.hpp"

#include <cmath>

namespace gearsweep {
namespace {

constexpr double kConfidence = 0.95;

// That at most `found` of the points are such, where a share of all is.
double probability(std::size_t found, std::size_t points, double share) {
  const auto n = static_cast<double>(points);
  double sum = 0.0;
  for (std::size_t i = 0; i <= found; ++i) {
    const auto k = static_cast<double>(i);
    const double ways = std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
    sum += std::exp(ways + k * std::log(share) + (n - k) * std::log1p(-share));
  }
  return sum;
}

}  // namespace

double upper_share(std::size_t found, std::size_t points) {
  if (found >= points) return 1.0;
  double low = static_cast<double>(found) / static_cast<double>(points), high = 1.0;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (probability(found, points, middle) > 1.0 - kConfidence ? low : high) = middle;
  }
  return high;
}

}  // namespace gearsweep
