#include "orbits/flow.hpp"

#include <cmath>

namespace gearsweep {

void Extent::take(const Eigen::VectorXd& state) {
  min = min.cwiseMin(state);
  max = max.cwiseMax(state);
}

Flow::Flow(const Model& model, const ModelSetting& setting, PreparedPoint* point,
           const PhaseGrid& grid, double duration, const Eigen::VectorXd& state,
           const Eigen::MatrixXd& tangents)
    : row_at_(model.phase_rows(setting)),
      grid_(grid),
      duration_(duration),
      row_width_(model.phase_coefs.size()),
      surfaces_(model.surfaces.size()),
      contacts_(model, *point),
      held_(model, point),
      step_(&held_),
      grazes_(model.contact_limits().size()),
      extent_{state, state},
      return_level_(model, &held_),
      at_{state, tangents} {}

void Flow::advance_grid(bool counts_returns) {
  const double* coefs = grid_.coefs.data();
  double phase = 0.0;
  PartCallback each_part;
  if (counts_returns && surfaces_ > 0) {
    each_part = [&](double, double, const HeldMotion& before, const HeldMotion& after) {
      take_return(coefs, before.state);
      take_return(coefs, after.state);
    };
  }
  const TurnCallback each_turn = [&](const Turn& turn) { take_turn(turn); };
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double length = grid_.segment_fractions[segment];
    const std::uint32_t count = grid_.segment_steps[segment];
    const double inside = phase + 0.5 * length * count;
    held_.begin(coefs, length * duration_, at_.state.data());
    if (counts_returns) take_return(coefs, at_.state);
    for (std::uint32_t i = 0; i < count; ++i) {
      const StepMoments moments = {&row_at_,  row_width_, phase + length * i, length, inside,
                                   duration_, coefs};
      step_.take(moments, &at_, each_part, each_turn);
      if (counts_returns) take_return(coefs, at_.state);
      extent_.take(at_.state);
      coefs += 2 * row_width_;
    }
    phase += length * count;
    coefs += row_width_;  // the next segment has its own one-sided row at the break phase
  }
}

void Flow::take_return(const double* coefs, const Eigen::VectorXd& state) {
  returns_.take(return_level_(coefs, state.data()));
}

void Flow::take_turn(const Turn& turn) {
  if (!held_.is_contact(turn.surface)) return;
  const std::size_t flank = turn.surface - surfaces_;
  const double distance = std::fabs(turn.clearance);
  if (distance >= grazes_[flank].distance) return;
  grazes_[flank] = {distance, turn.bend, contacts_.force_at(turn.coefs, turn.state->data(), flank),
                    contacts_.gradient_at(turn.coefs, turn.state->data(), flank)};
}

}  // namespace gearsweep
