#include "plan/detail/local_field.hpp"

namespace gearsweep {

LocalField local_field_at(const Model& model, const ModelSetting& setting,
                          const std::vector<double>& own) {
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
  LocalField local;
  for (const std::size_t row : kept) {
    local.rates.push_back(dx[row]);
    for (const std::size_t column : kept) {
      local.jacobian.push_back(jacobian[row * states + column]);
    }
  }
  return local;
}

}  // namespace gearsweep
