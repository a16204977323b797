#include "orbits/period_map.hpp"

namespace gearsweep {

using Eigen::MatrixXd;
using Eigen::VectorXd;

PeriodMap::PeriodMap(const Model& model, const ModelSetting& setting, std::size_t steps,
                     const std::atomic<bool>* stop)
    : model_(&model),
      setting_(setting),
      grid_(make_phase_grid(model, setting, steps)),
      point_(model.prepare(setting)),
      stop_(stop) {}

bool PeriodMap::driven() const {
  const std::size_t width = model_->phase_coefs.size();
  for (std::size_t i = width; i < grid_.coefs.size(); ++i) {
    if (grid_.coefs[i] != grid_.coefs[i - width]) return true;
  }
  return false;
}

bool PeriodMap::advance(Flow* flow, std::size_t periods) const {
  for (std::size_t i = 0; i < periods; ++i) {
    if (stop_ != nullptr && *stop_) throw SearchStopped();
    flow->advance_period();
    const VectorXd& state = flow->state();
    if (!model_->is_within_limits({state.data(), static_cast<std::size_t>(state.size())})) {
      return false;
    }
  }
  return true;
}

std::optional<VectorXd> PeriodMap::advance(const VectorXd& state, std::size_t periods) const {
  Flow flow(*model_, setting_, point_.get(), grid_, state, MatrixXd(state.size(), 0));
  if (!advance(&flow, periods)) return std::nullopt;
  return flow.state();
}

std::optional<PeriodImage> PeriodMap::linearize(const VectorXd& state, std::size_t periods) const {
  Flow flow(*model_, setting_, point_.get(), grid_, state,
            MatrixXd::Identity(state.size(), state.size()));
  if (!advance(&flow, periods)) return std::nullopt;
  return PeriodImage{flow.state(), flow.tangents(), flow.nearest_grazes(), flow.extent()};
}

}  // namespace gearsweep
