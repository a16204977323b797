#include "orbits/period_map.hpp"

#include <cmath>
#include <numbers>

#include "model/held_field.hpp"

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

bool PeriodMap::advance(Flow* flow, std::size_t times, bool counts_returns) const {
  for (std::size_t i = 0; i < times; ++i) {
    if (stop_ != nullptr && *stop_) throw SearchStopped();
    flow->advance_grid(counts_returns);
    const VectorXd& state = flow->state();
    if (!model_->is_within_limits({state.data(), static_cast<std::size_t>(state.size())})) {
      return false;
    }
  }
  return true;
}

namespace {

PeriodImage image_of(const Flow& flow) {
  return {flow.state(), flow.tangents(), flow.nearest_grazes(), flow.extent(),
          flow.returns().of_closed_way()};
}

}  // namespace

std::optional<VectorXd> PeriodMap::advance(const VectorXd& state, std::size_t periods) const {
  Flow flow(*model_, setting_, point_.get(), grid_, period(), state, MatrixXd(state.size(), 0));
  if (!advance(&flow, periods)) return std::nullopt;
  return flow.state();
}

std::optional<PeriodImage> PeriodMap::linearize(const VectorXd& state, std::size_t periods) const {
  Flow flow(*model_, setting_, point_.get(), grid_, period(), state,
            MatrixXd::Identity(state.size(), state.size()));
  if (!advance(&flow, periods)) return std::nullopt;
  return image_of(flow);
}

PhaseGrid PeriodMap::grid_of(const TimeSpan& span) const {
  // All rows are the same: nothing depends on the phase.
  const std::size_t width = model_->phase_coefs.size();
  PhaseGrid grid;
  grid.segment_steps = {static_cast<std::uint32_t>(span.steps)};
  grid.segment_fractions = {1.0 / static_cast<double>(span.steps)};
  grid.steps = span.steps;
  for (std::size_t row = 0; row <= 2 * span.steps; ++row) {
    grid.coefs.insert(grid.coefs.end(), grid_.coefs.begin(),
                      grid_.coefs.begin() + static_cast<std::ptrdiff_t>(width));
  }
  return grid;
}

std::optional<PeriodMap::Way> PeriodMap::way(const VectorXd& state, const TimeSpan& span) const {
  const PhaseGrid grid = grid_of(span);
  Flow flow(*model_, setting_, point_.get(), grid, span.duration, state, MatrixXd(state.size(), 0));
  if (!advance(&flow, 1, true)) return std::nullopt;
  return Way{flow.state(), flow.returns().so_far()};
}

std::optional<VectorXd> PeriodMap::advance(const VectorXd& state, const TimeSpan& span) const {
  const PhaseGrid grid = grid_of(span);
  Flow flow(*model_, setting_, point_.get(), grid, span.duration, state, MatrixXd(state.size(), 0));
  if (!advance(&flow, 1)) return std::nullopt;
  return flow.state();
}

std::optional<PeriodImage> PeriodMap::linearize(const VectorXd& state, const TimeSpan& span) const {
  const PhaseGrid grid = grid_of(span);
  Flow flow(*model_, setting_, point_.get(), grid, span.duration, state,
            MatrixXd::Identity(state.size(), state.size()));
  if (!advance(&flow, 1, true)) return std::nullopt;
  return image_of(flow);
}

VectorXd PeriodMap::rate(const VectorXd& state) const {
  HeldField field(*model_, point_.get());
  field.begin(grid_.coefs.data(), period() / static_cast<double>(steps()), state.data());
  VectorXd out(state.size());
  field.rhs(grid_.coefs.data(), state.data(), out.data());
  return out;
}

MatrixXd PeriodMap::rate_slope(const VectorXd& state) const {
  HeldField field(*model_, point_.get());
  field.begin(grid_.coefs.data(), period() / static_cast<double>(steps()), state.data());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> out(state.size(),
                                                                             state.size());
  field.jacobian(grid_.coefs.data(), state.data(), out.data());
  return out;
}

VectorXd PeriodMap::levels(const VectorXd& state) const {
  HeldField field(*model_, point_.get());
  field.begin(grid_.coefs.data(), period() / static_cast<double>(steps()), state.data());
  const std::vector<double> values = field.levels(grid_.coefs.data(), state.data()).value;
  VectorXd out = VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const bool is_staircase = model_->surfaces[static_cast<std::size_t>(i)].is_staircase;
    if (is_staircase) out[i] -= std::round(out[i]);
  }
  return out;
}

VectorXd PeriodMap::difference(const VectorXd& to, const VectorXd& from) const {
  VectorXd out = to - from;
  for (const std::size_t angle : model_->angles) {
    double& turn = out[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return out;
}

}  // namespace gearsweep
