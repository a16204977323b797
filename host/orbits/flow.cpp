#include "orbits/flow.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

constexpr int kMaxEvents = 16;        // in one step; more are rounding
constexpr double kSameShare = 1e-16;  // of a step
constexpr double kGolden = 0.6180339887498949;
constexpr double kTurnFound = 1e-9;  // of a step: a minimum is flat

}  // namespace

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
      field_(model, *point),
      held_(model, point),
      has_surfaces_(!model.surfaces.empty()),
      grazes_(model.contact_limits().size()),
      extent_{state, state},
      return_level_(model, *point, &held_),
      at_{state, tangents},
      start_(at_),
      moving_{at_, at_, at_},
      probe_{state, Eigen::MatrixXd(state.size(), 0)},
      probing_{probe_, probe_, probe_},
      jacobian_(state.size(), state.size()) {
  rows_.fill(std::vector<double>(row_width_));
}

void Flow::advance_grid(bool counts_returns) {
  const double* coefs = grid_.coefs.data();
  double phase = 0.0;
  PartCallback each_part;
  if (counts_returns && has_surfaces_) {
    each_part = [&](double, double, const HeldMotion& before, const HeldMotion& after) {
      take_return(coefs, before.state);
      take_return(coefs, after.state);
    };
  }
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double length = grid_.segment_fractions[segment];
    const std::uint32_t count = grid_.segment_steps[segment];
    const double inside = phase + 0.5 * length * count;
    if (has_surfaces_) {
      const GridStep first = {coefs, phase, length, inside};
      held_.begin(moments_of(first)(0.0).data(), length * duration_, at_.state.data());
    }
    if (counts_returns) take_return(coefs, at_.state);
    for (std::uint32_t i = 0; i < count; ++i) {
      const GridStep step = {coefs, phase + length * i, length, inside};
      has_surfaces_ ? step_held(&held_, moments_of(step), &at_, each_part) : advance(step);
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

StepMoments Flow::moments_of(const GridStep& step) const {
  return {&row_at_, row_width_, step.phase, step.length, step.inside, duration_};
}

void Flow::advance(const GridStep& step) {
  Part part{step, 0.0, contact_of(field_.depths(step.coefs, at_.state))};
  for (int events = 0;; ++events) {
    start_ = at_;
    const Seen seen = carry(part, 1.0, &at_);
    if (events == kMaxEvents || !at_.state.allFinite()) return;
    const std::optional<Event> event = first_event(part, seen);
    if (!event) return;
    at_ = start_;
    carry(part, event->share, &at_);
    part.held[event->flank] = !part.held[event->flank];
    part.from = event->share;
  }
}

Flow::Seen Flow::carry(const Part& part, double to, Carried* carried) {
  const double h = (to - part.from) * part.step.length * duration_;
  const double* const first = coefs_at(part.step, part.from, &rows_[0]);
  const double* const middle = coefs_at(part.step, 0.5 * (part.from + to), &rows_[1]);
  const double* const last = coefs_at(part.step, to, &rows_[2]);
  Work& work = carried == &probe_ ? probing_ : moving_;
  const auto reach = [&](double length) {
    work.at.state = carried->state + length * work.slope.state;
    work.at.tangents = carried->tangents + length * work.slope.tangents;
  };
  const auto add = [&](double weight) {
    work.sum.state += weight * work.slope.state;
    work.sum.tangents += weight * work.slope.tangents;
  };
  Seen seen;
  work.sum = *carried;
  seen[0] = stage(first, part.held, *carried, &work.slope);
  add(h / 6.0);
  reach(0.5 * h);
  const Depths second = stage(middle, part.held, work.at, &work.slope);
  add(h / 3.0);
  reach(0.5 * h);
  const Depths third = stage(middle, part.held, work.at, &work.slope);
  add(h / 3.0);
  reach(h);
  stage(last, part.held, work.at, &work.slope);
  add(h / 6.0);
  *carried = work.sum;
  for (std::size_t i = 0; i < second.size(); ++i) seen[1].push_back(0.5 * (second[i] + third[i]));
  seen[2] = field_.depths(last, carried->state);
  return seen;
}

Depths Flow::stage(const double* coefs, const Contact& held, const Carried& at, Carried* slope) {
  if (at.tangents.cols() > 0) {
    field_.jacobian(coefs, at.state, held, &jacobian_);
    slope->tangents.noalias() = jacobian_ * at.tangents;
  }
  return field_.slope(coefs, at.state, held, &slope->state);
}

const double* Flow::coefs_at(const GridStep& step, double share, std::vector<double>* row) const {
  if (share == 0.0) return step.coefs;
  if (share == 0.5) return step.coefs + row_width_;
  if (share == 1.0) return step.coefs + 2 * row_width_;
  row_at_(step.phase + share * step.length, step.inside, row->data());
  return row->data();
}

double Flow::clearance(const Part& part, std::size_t flank, double share) {
  probe_.state = start_.state;
  const double depth = carry(part, share, &probe_)[2][flank];
  return part.held[flank] ? depth : -depth;
}

Flow::Turn Flow::find_turn(const Part& part, std::size_t flank) {
  const auto at = [&](double share) { return Turn{share, clearance(part, flank, share)}; };
  double low = part.from, high = 1.0;
  Turn left = at(high - kGolden * (high - low)), right = at(low + kGolden * (high - low));
  while (high - low > kTurnFound) {
    if (left.clearance < right.clearance) {
      high = right.share;
      right = left;
      left = at(high - kGolden * (high - low));
    } else {
      low = left.share;
      left = right;
      right = at(low + kGolden * (high - low));
    }
  }
  return left.clearance < right.clearance ? left : right;
}

std::optional<double> Flow::share_beyond(const Part& part, std::size_t flank, const Seen& seen) {
  if ((seen[2][flank] > 0.0) != part.held[flank]) return 1.0;
  // The parabola through the three, in shares of the part: does it have a minimum?
  const double side = part.held[flank] ? 1.0 : -1.0;
  const double first = side * seen[0][flank], last = side * seen[2][flank];
  const double bend = 2.0 * (first - 2.0 * side * seen[1][flank] + last);
  const double slope = last - first - bend;
  if (slope >= 0.0 || slope + 2.0 * bend <= 0.0) return std::nullopt;
  Turn turn{1.0, first - 0.25 * slope * slope / bend};
  // Far from the limit the parabola is good enough.
  if (turn.clearance < bend) turn = find_turn(part, flank);
  const double distance = std::fabs(turn.clearance);
  if (distance < grazes_[flank].distance) {
    const double h = (1.0 - part.from) * part.step.length * duration_;
    grazes_[flank] = {distance, 2.0 * bend / (h * h),
                      field_.force_at(part.step.coefs, start_.state, flank),
                      field_.gradient_at(part.step.coefs, start_.state, flank)};
  }
  if (turn.clearance > 0.0) return std::nullopt;
  return turn.share;
}

std::optional<Flow::Event> Flow::first_event(const Part& part, const Seen& seen) {
  std::optional<Event> first;
  for (std::size_t flank = 0; flank < part.held.size(); ++flank) {
    const std::optional<double> beyond = share_beyond(part, flank, seen);
    if (!beyond) continue;
    double low = part.from, high = *beyond;
    while (high - low > kSameShare) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      // It ends beyond the limit: at it, a corner's equations may be those of either side.
      (clearance(part, flank, middle) >= 0.0 ? low : high) = middle;
    }
    if (!first || high < first->share) first = Event{flank, high};
  }
  return first;
}

}  // namespace gearsweep
