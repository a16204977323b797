// What repeated measurements say together.
#pragma once

#include <vector>

namespace gearsweep {

// None of them takes an empty list.
double median(std::vector<double> values);
double mean(const std::vector<double>& values);
// The deviation of a sample: over the number of values less one; 0 of a single value.
double standard_deviation(const std::vector<double>& values);
// (largest - smallest) / median.
double spread(const std::vector<double>& values);

}  // namespace gearsweep
