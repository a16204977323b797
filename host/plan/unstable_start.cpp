#include "plan/unstable_start.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "model/eigenvalues.hpp"

namespace gearsweep {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The field and its Jacobian at a state of the whole model, of the states that are kept: the others
// drive none of these.
struct Local {
  std::vector<double> rates;     // [state]
  std::vector<double> jacobian;  // [row][column]
};

Local local_at(const Model& model, const ModelSetting& setting, const std::vector<double>& own) {
  const Model& whole = model.full();
  const std::size_t states = whole.states.size();
  std::vector<std::size_t> kept = model.reduction.kept;
  for (std::size_t i = 0; model.whole == nullptr && i < states; ++i) kept.push_back(i);
  std::vector<double> x(states), dx(states), jacobian(states * states);
  for (std::size_t i = 0; i < kept.size(); ++i) x[kept[i]] = own[i];
  std::vector<double> coefs(whole.phase_coefs.size());
  whole.phase_coefs_at(setting, 0.0, 1e-9, coefs.data());
  const auto point = whole.prepare(setting);
  point->rhs(coefs.data(), x.data(), dx.data());
  point->jacobian(coefs.data(), x.data(), jacobian.data());
  Local local;
  for (const std::size_t row : kept) {
    local.rates.push_back(dx[row]);
    for (const std::size_t column : kept) {
      local.jacobian.push_back(jacobian[row * states + column]);
    }
  }
  return local;
}

// To within the rounding of the states themselves, some operations long.
bool vanishes(const Local& local, const std::vector<double>& x) {
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
bool is_unstable(const Local& local, std::size_t states) {
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
  const Local local = local_at(model, plan.setting_of(point), start);
  return vanishes(local, start) && is_unstable(local, start.size());
}

}  // namespace gearsweep
