#include "model/held_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearsweep {
namespace {

constexpr int kMaxParts = 512;  // of a step
constexpr int kMaxBends = 16;   // limits of contacts that are crossed in a step; more are rounding
constexpr std::size_t kLooks = 4;
constexpr double kTurnFound = 1e-9;  // of a step: a minimum is flat
constexpr int kMaxParabolas = 8;     // till then

}  // namespace

const double* StepMoments::at(double share, std::vector<double>* row) const {
  if (rows != nullptr && share == 0.0) return rows;
  if (rows != nullptr && share == 0.5) return rows + width;
  if (rows != nullptr && share == 1.0) return rows + 2 * width;
  row->resize(width);
  (*row_at)(std::min(phase + share * length, 1.0), inside, row->data());
  return row->data();
}

std::vector<double> StepMoments::operator()(double share) const {
  std::vector<double> row(width);
  const double* const coefs = at(share, &row);
  if (coefs != row.data()) std::copy_n(coefs, width, row.begin());
  return row;
}

void HeldStep::carry(const StepMoments& moment_at, double from, double to, HeldMotion* motion) {
  carry(moment_at, from, to, motion, motion->tangents.cols() > 0 ? &moving_ : &probing_);
}

void HeldStep::carry(const StepMoments& moment_at, double from, double to, HeldMotion* motion,
                     Work* work) {
  const double h = (to - from) * moment_at.length * moment_at.period;
  const double* const first = moment_at.at(from, &rows_[0]);
  const double* const middle = moment_at.at(0.5 * (from + to), &rows_[1]);
  const double* const last = moment_at.at(to, &rows_[2]);
  const bool has_tangents = motion->tangents.cols() > 0;
  const auto reach = [&](double length) {
    work->at.state = motion->state + length * work->slope.state;
    if (has_tangents) work->at.tangents = motion->tangents + length * work->slope.tangents;
  };
  const auto add = [&](double weight) {
    work->sum.state += weight * work->slope.state;
    if (has_tangents) work->sum.tangents += weight * work->slope.tangents;
  };
  work->sum = *motion;
  stage(first, *motion, work);
  add(h / 6.0);
  reach(0.5 * h);
  work->middle = 0.5 * work->at.state;
  stage(middle, work->at, work);
  add(h / 3.0);
  reach(0.5 * h);
  work->middle += 0.5 * work->at.state;
  stage(middle, work->at, work);
  add(h / 3.0);
  reach(h);
  stage(last, work->at, work);
  add(h / 6.0);
  *motion = work->sum;
  field_->put_back(last, motion->state.data());
}

void HeldStep::stage(const double* coefs, const HeldMotion& at, Work* work) {
  const Eigen::Index states = at.state.size();
  work->slope.state.resize(states);
  field_->rhs(coefs, at.state.data(), work->slope.state.data());
  if (at.tangents.cols() == 0) return;
  work->jacobian.resize(states, states);
  field_->jacobian(coefs, at.state.data(), work->jacobian.data());
  // Products that are made for large matrices cost more than these do.
  work->slope.tangents.noalias() = work->jacobian.lazyProduct(at.tangents);
}

void HeldStep::take(const StepMoments& moment_at, HeldMotion* motion, const PartCallback& each_part,
                    const TurnCallback& each_turn) {
  Part part{moment_at, 0.0, each_turn};
  field_->hold_contacts(moment_at.at(0.0, &row_), motion->state.data());
  int bends = 0;
  for (int cuts = 1; cuts <= kMaxParts; ++cuts) {
    field_->settle(moment_at.at(part.from, &row_), motion);
    start_ = *motion;
    look(part.from, moment_at.at(part.from, &row_), start_.state, &looks_[0]);
    carry(moment_at, part.from, 1.0, motion);
    const Work& work = motion->tangents.cols() > 0 ? moving_ : probing_;
    const double middle = 0.5 * (part.from + 1.0);
    look(middle, moment_at.at(middle, &row_), work.middle, &looks_[1]);
    look(1.0, moment_at.at(1.0, &row_), motion->state, &looks_[2]);
    if (!motion->state.allFinite()) return;
    const std::optional<double> event = first_event(part);
    const double to = event.value_or(1.0);
    if (event && to < 1.0) {
      *motion = start_;
      carry(moment_at, part.from, to, motion);
    }
    if (each_part && part.from < to) each_part(part.from, to, start_, *motion);
    if (!event) return;
    const double* const coefs = moment_at.at(to, &row_);
    if (const auto surface = field_->left_behind(coefs, motion->state.data())) {
      if (field_->is_contact(*surface) && ++bends > kMaxBends) {
        field_->free_contacts();
      } else {
        field_->pass(*surface, coefs, cuts, motion);
      }
    }
    if (to == 1.0) return;
    part.from = to;
  }
  motion->state.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void HeldStep::look(double share, const double* coefs, const Eigen::VectorXd& state, Look* out) {
  out->share = share;
  out->values = field_->clearances(coefs, state.data());
}

void HeldStep::look(const Part& part, double share, Look* out) {
  probe_.state = start_.state;
  carry(part.moment_at, part.from, share, &probe_, &probing_);
  look(share, part.moment_at.at(share, &row_), probe_.state, out);
}

double HeldStep::clearance(const Part& part, std::size_t index, double share) {
  probe_.state = start_.state;
  carry(part.moment_at, part.from, share, &probe_, &probing_);
  return field_->clearances(part.moment_at.at(share, &row_), probe_.state.data())[index].value;
}

std::optional<double> HeldStep::first_event(const Part& part) {
  close_.clear();
  std::optional<double> first;
  for (std::size_t i = 0; i < looks_[0].values.size(); ++i) {
    const std::optional<Way> way = way_beyond(part, i);
    if (!way || (first && way->inside >= *first)) continue;
    double low = way->inside, high = way->beyond;
    for (double middle = 0.5 * (low + high); low < middle && middle < high;
         middle = 0.5 * (low + high)) {
      // It ends beyond the limit: at it, a corner's equations may be those of either side.
      (clearance(part, i, middle) >= 0.0 ? low : high) = middle;
    }
    if (!first || high < *first) first = high;
  }
  return first;
}

std::optional<HeldStep::Way> HeldStep::way_beyond(const Part& part, std::size_t index) {
  const double first = looks_[0].values[index].value, middle = looks_[1].values[index].value,
               last = looks_[2].values[index].value;
  if (!(first >= 0.0)) return Way{part.from, part.from};
  const auto [low, high] = std::minmax({first, middle, last});
  if (!(low > high - low)) return way_beyond_near(part, index);
  // Far from it the parabola through the three is good enough.
  const double bend = first - 2.0 * middle + last, slope = 0.5 * (last - first);
  if (std::fabs(slope) < bend) {
    tell_turn(part, index, middle - 0.5 * slope * slope / bend, bend, 0.5 * (1.0 - part.from));
  }
  return std::nullopt;
}

std::optional<HeldStep::Way> HeldStep::way_beyond_near(const Part& part, std::size_t index) {
  const double spacing = (1.0 - part.from) / kLooks;
  if (close_.empty()) {
    close_.resize(kLooks + 1);
    close_.front() = looks_.front();
    close_.back() = looks_.back();
    for (std::size_t k = 1; k < kLooks; ++k) {
      look(part, part.from + spacing * static_cast<double>(k), &close_[k]);
    }
  }
  std::optional<Way> way;
  // A dip beyond that ends within the step is a turn, too, however far it goes.
  const bool ends_inside = looks_[2].values[index].value >= 0.0;
  for (std::size_t k = 1; k <= kLooks; ++k) {
    if (!way && !(close_[k].values[index].value >= 0.0)) {
      way = Way{close_[k - 1].share, close_[k].share};
    }
    if (k == kLooks || (way && !ends_inside)) break;
    const double before = close_[k - 1].values[index].value, at = close_[k].values[index].value,
                 behind = close_[k + 1].values[index].value;
    const double bend = before - 2.0 * at + behind, slope = 0.5 * (behind - before);
    if (!(std::fabs(slope) < bend)) continue;
    ClearanceAt turn = {close_[k].share, at - 0.5 * slope * slope / bend};
    if (turn.clearance < bend) {
      turn = find_turn(part, index, {close_[k - 1].share, before}, {close_[k].share, at},
                       {close_[k + 1].share, behind});
    }
    if (ends_inside || turn.clearance >= 0.0) tell_turn(part, index, turn.clearance, bend, spacing);
    if (!way && turn.clearance < 0.0) way = Way{close_[k - 1].share, turn.share};
  }
  return way;
}

HeldStep::ClearanceAt HeldStep::find_turn(const Part& part, std::size_t index, ClearanceAt low,
                                          ClearanceAt at, ClearanceAt high) {
  for (int i = 0; i < kMaxParabolas; ++i) {
    // The vertex of the parabola through the three (successive parabolic interpolation).
    const double before = at.share - low.share, behind = high.share - at.share;
    const double fall = before * (at.clearance - high.clearance),
                 rise = behind * (at.clearance - low.clearance);
    const double way = 0.5 * (behind * rise - before * fall) / (fall + rise);
    const double share = at.share + way;
    if (!(low.share < share && share < high.share) || std::fabs(way) < kTurnFound) break;
    const ClearanceAt next = {share, clearance(part, index, share)};
    if (next.clearance < at.clearance) {
      (way > 0.0 ? low : high) = at;
      at = next;
    } else {
      (way > 0.0 ? high : low) = next;
    }
  }
  return at;
}

void HeldStep::tell_turn(const Part& part, std::size_t index, double clearance, double bend,
                         double spacing) const {
  if (!part.each_turn) return;
  const double h = spacing * part.moment_at.length * part.moment_at.period;
  std::vector<double> row;
  const double* const coefs = part.moment_at.at(part.from, &row);
  part.each_turn(
      {looks_[0].values[index].surface, clearance, bend / (h * h), coefs, &start_.state});
}

}  // namespace gearsweep
