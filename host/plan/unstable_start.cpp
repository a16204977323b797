#include "plan/unstable_start.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "model/eigenvalues.hpp"
#include "plan/detail/local_field.hpp"

namespace gearsweep {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// To within the rounding of the states themselves, some operations long.
bool vanishes(const LocalField& local, const std::vector<double>& x) {
  constexpr double kOperations = 16.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    double size = 0.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      size += std::abs(local.jacobian[row * x.size() + j] * x[j]);
    }
    if (!(std::abs(local.rates[row]) <= kOperations * kEpsilon * size)) return false;
  }
  return true;
}

// Rounding moves an eigenvalue that is a triple one by the third root of it.
bool is_unstable(const LocalField& local, std::size_t states) {
  double largest_size = 0.0, largest_growth = 0.0;
  // A transposed matrix has the same eigenvalues.
  for (const std::complex<double>& value : eigenvalues(local.jacobian.data(), states)) {
    largest_size = std::max(largest_size, std::abs(value));
    largest_growth = std::max(largest_growth, value.real());
  }
  return largest_growth > std::cbrt(kEpsilon) * largest_size;
}

}  // namespace

bool starts_unstable(const Plan& plan, std::size_t point, const std::vector<double>& start) {
  const Model& model = *plan.study().model;
  if (!model.reduction.mirrors.empty()) return false;
  const LocalField local = local_field_at(model, plan.setting_of(point), start);
  return vanishes(local, start) && is_unstable(local, start.size());
}

}  // namespace gearsweep
