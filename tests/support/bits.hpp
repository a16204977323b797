// Comparing numbers by their bits: NaN equals NaN, -0 is not 0.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace gearsweep::testing {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// How many elements differ; all of them when the lengths do.
inline std::size_t different_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return a.size() + b.size();
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += same_bits(a[i], b[i]) ? 0 : 1;
  return count;
}

}  // namespace gearsweep::testing
