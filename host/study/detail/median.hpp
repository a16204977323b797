#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gearsweep {

// The upper one of two in the middle; there is one number at least.
inline double median_of(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::ranges::nth_element(numbers, middle);
  return *middle;
}

}  // namespace gearsweep
