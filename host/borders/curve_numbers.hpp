// Curves as a row of numbers, every bit of them, as a journal keeps them.
#pragma once

#include <span>
#include <vector>

#include "borders/border_curve.hpp"

namespace gearsweep {

std::vector<double> numbers_of(const std::vector<BorderCurve>& curves);
// Throws InputError where the numbers are none of curves.
std::vector<BorderCurve> curves_of(std::span<const double> numbers);

}  // namespace gearsweep
