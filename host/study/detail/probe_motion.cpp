#include "study/detail/probe_motion.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace gearsweep {
namespace {

constexpr double kAimedError = 5e-8, kMaxError = 1e-4;  // of the steps that are taken
constexpr double kFirstStep = 0.01;                     // times the fastest rate
// A share of all time: a motion with such steps has come to a time that it does not pass.
constexpr double kShortestStep = 1e-12;
constexpr double kSamePhase = 1e-9;
constexpr int kMostHidden = 20;  // halvings of a step: what has no bound there is at a point
constexpr std::size_t kMostTaken = 10;

std::vector<double> bounds_of(const Model& model, const ModelSetting& setting) {
  std::vector<double> breaks = model.break_phases(setting);
  std::ranges::sort(breaks);
  std::vector<double> bounds = {0.0};
  for (const double phase : breaks) {
    if (phase > bounds.back() + kSamePhase && phase < 1.0 - kSamePhase) bounds.push_back(phase);
  }
  bounds.push_back(1.0);
  return bounds;
}

constexpr std::size_t kPhaseSamples = 4096;  // of a period, to find pulses: some 2 ms

// An eigenvalue takes as many operations as 25 products of matrices.
std::size_t steps_between_rates(std::size_t states) {
  return std::clamp<std::size_t>(states * states / 8, 10, 200);
}

bool is_finite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

}  // namespace

ProbeMotion::ProbeMotion(const Model& model, ModelSetting setting, std::vector<double> start)
    : model_(model),
      setting_(std::move(setting)),
      is_forced_(!model.is_autonomous),
      point_(model.prepare(setting_)),
      row_at_(model.phase_rows(setting_)),
      held_(model, point_.get()),
      held_step_(&held_),
      is_rough_(model.is_rough || !model.uncorrected.empty() ||
                !model.state_jumps(setting_).empty()),
      period_(point_->period()),
      bounds_(bounds_of(model, setting_)),
      x_(std::move(start)) {
  if (is_forced_) find_pulses();
  if (!is_forced_ && model.surfaces.empty()) reach_.emplace(model, setting_);
}

void ProbeMotion::find_pulses() {
  constexpr double kFast = 8.0;  // times the average
  constexpr std::size_t kMaxPulses = 100;
  const std::size_t width = model_.phase_coefs.size();
  std::vector<double> before(width), now(width), all(width);
  const auto is_inside = [&](std::size_t i) {  // the samples i and i + 1 lie in one segment
    return std::ranges::none_of(bounds_, [&](double bound) {
      return bound * kPhaseSamples > static_cast<double>(i) &&
             bound * kPhaseSamples < static_cast<double>(i + 1);
    });
  };
  std::vector<std::vector<double>> changes(kPhaseSamples, std::vector<double>(width));
  for (std::size_t i = 0; i <= kPhaseSamples; ++i) {
    const double phase = static_cast<double>(i) / kPhaseSamples;
    const double within = std::min(phase, 1.0 - 0.5 / kPhaseSamples);
    row_at_(phase, within, now.data());
    for (std::size_t j = 0; i > 0 && j < width; ++j) {
      const double change = is_inside(i - 1) ? std::abs(now[j] - before[j]) : 0.0;
      changes[i - 1][j] = change;
      all[j] += change;
    }
    before = now;
  }
  bool was_fast = true;  // what a period begins with is seen
  for (std::size_t i = 0; i < kPhaseSamples && pulses_.size() < kMaxPulses; ++i) {
    bool is_fast = false;
    for (std::size_t j = 0; j < width; ++j) {
      is_fast |= changes[i][j] > kFast * all[j] / kPhaseSamples;
    }
    if (is_fast && !was_fast) {
      pulses_.push_back(std::max(static_cast<double>(i) - 4.0, 0.5) / kPhaseSamples);
    }
    was_fast = is_fast;
  }
}

double ProbeMotion::next_pulse(double phase) const {
  const auto next = std::ranges::upper_bound(pulses_, phase + 1e-9);
  return next == pulses_.end() ? 2.0 : *next;
}

ProbeMotion::Stretch ProbeMotion::go_on(std::size_t steps) {
  Stretch stretch;
  stretch.low = stretch.high = x_;
  stretch.rounding.assign(x_.size(), 0.0);
  look_at_signals(&stretch);
  const std::size_t between = steps_between_rates(x_.size());
  double turns = 0.0;    // periods that were gone through
  std::size_t done = 0;  // steps that were not shortened because of what they may hide
  for (std::size_t taken = 0; done < steps && taken < kMostTaken * steps && !escapes_; ++taken) {
    if (taken % between == 0) {
      look_at_rates(&stretch);
      // A forcing may be slower than all this: look at each part of its period.
      const double due = static_cast<double>(done) / static_cast<double>(steps);
      if (is_forced_ && turns < due) turns += leap(due - turns);
      look_at_sides();
    }
    NextStep next = aim(stretch);
    shorten(stretch, &next);
    if (escapes_) return stretch;
    take(&next, &stretch);
    turns += next.length / period_;
    if (next.hidden == 0) ++done;
    set_next_length(next);
  }
  return stretch;
}

double ProbeMotion::leap(double turns) {
  const double ahead = std::min(turns, next_pulse(phase_) - phase_);
  phase_ = std::fmod(phase_ + ahead, 1.0);
  segment_ = 0;
  while (bounds_[segment_ + 1] <= phase_) ++segment_;
  return ahead;
}

ProbeMotion::NextStep ProbeMotion::aim(const Stretch& stretch) {
  NextStep next;
  // At rest no error holds the step back.
  next.max_length = stretch.rate > 0.0 ? 1.0 / stretch.rate : period_;
  if (is_forced_) next.max_length = std::min(next.max_length, period_ / kForcedSteps);
  if (length_ == 0.0) length_ = stretch.rate > 0.0 ? kFirstStep / stretch.rate : period_ / 1024;
  const double left = (bounds_[segment_ + 1] - phase_) * period_;
  const bool ends_segment = is_forced_ && length_ >= left * (1.0 - 1e-9);
  next.length = std::min(ends_segment ? left : length_, next.max_length);
  const double pulse = next_pulse(phase_);
  next.meets_pulse = is_forced_ && phase_ + next.length / period_ > pulse;
  if (next.meets_pulse) next.length = (pulse - phase_) * period_;
  if (ends_segment) next.left = left;
  return next;
}

void ProbeMotion::shorten(const Stretch& stretch, NextStep* next) {
  double& length = next->length;
  Trial& trial = next->trial;
  trial = attempt(stretch, length);
  next->fit = length;
  while (!(trial.excess <= kMaxError) ||
         (next->hidden < kMostHidden && hides_something(stretch, trial, length))) {
    if (trial.excess <= kMaxError) {
      ++next->hidden;
      --halvings_left_;
    }
    Trial half = attempt(stretch, 0.5 * length);
    next->is_smooth = !(half.excess > trial.excess / 8.0) || trial.excess <= kMaxError ||
                      (!is_forced_ && !may_bend(trial, length, phase_ + length / period_));
    if (!next->is_smooth && std::isfinite(trial.excess)) break;
    if (!(trial.excess <= kMaxError)) next->fit = 0.5 * length;
    length *= 0.5;
    trial = std::move(half);
    escapes_ = !(length >= kShortestStep * (time_ + length_)) || std::isinf(length);
    if (escapes_) return;
  }
  next->is_short = (next->ends_segment() || next->meets_pulse) && length < 0.5 * length_;
}

void ProbeMotion::take(NextStep* next, Stretch* stretch) {
  const double length = next->length;
  Trial& trial = next->trial;
  const double end_phase = next->ends_segment() ? bounds_[segment_ + 1] : phase_ + length / period_;
  const bool is_cut = meets_surface(length, &trial.end, stretch);
  if (next->is_smooth && !next->is_short && !is_cut && !crosses_limit(trial.end, end_phase)) {
    stretch->steps.push_back({length, std::move(trial.errors)});
  }
  x_ = std::move(trial.end);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    stretch->low[i] = std::min(stretch->low[i], x_[i]);
    stretch->high[i] = std::max(stretch->high[i], x_[i]);
  }
  time_ += length;
  phase_ = end_phase;
  look_at_signals(stretch);
  look_at_levels(coefs_at(phase_).data(), x_.data(), stretch);
  look_at_peaks(*stretch, length);
  if (!next->ends_segment()) return;
  segment_ = segment_ + 2 == bounds_.size() ? 0 : segment_ + 1;
  phase_ = bounds_[segment_];
  look_at_sides();
}

void ProbeMotion::set_next_length(const NextStep& taken) {
  const double excess = taken.trial.excess;
  const double factor = excess > 0.0 ? std::pow(kAimedError / excess, 0.2) : 2.0;
  if (taken.hidden > 0) {
    length_ = taken.fit;
  } else if (taken.is_smooth && !taken.is_short) {
    length_ = taken.length * std::clamp(factor, 0.3, 2.0);
  }
  if (taken.meets_pulse) length_ = std::min(length_, period_ / kPhaseSamples);
  length_ = std::min(length_, taken.max_length);
  escapes_ = length_ < kShortestStep * time_;
}

std::vector<double> ProbeMotion::coefs_at(double phase) const {
  std::vector<double> row(model_.phase_coefs.size());
  row_at_(phase, 0.5 * (bounds_[segment_] + bounds_[segment_ + 1]), row.data());
  return row;
}

StepMoments ProbeMotion::moments_of(double length) const {
  const double inside = 0.5 * (bounds_[segment_] + bounds_[segment_ + 1]);
  return {&row_at_, model_.phase_coefs.size(), phase_, length / period_, inside, period_};
}

void ProbeMotion::look_at_sides() {
  if (model_.surfaces.empty()) return;
  const double length = length_ > 0.0 ? length_ : period_ / 1024;
  held_.begin(moments_of(length)(0.0).data(), length, x_.data());
}

bool ProbeMotion::meets_surface(double length, std::vector<double>* end, Stretch* stretch) {
  if (model_.surfaces.empty()) return false;
  const StepMoments moment_at = moments_of(length);
  held_.put_back(moment_at(1.0).data(), end->data());
  if (!held_.left_behind(moment_at(1.0).data(), end->data())) return false;
  const auto size = static_cast<Eigen::Index>(x_.size());
  HeldMotion motion{Eigen::VectorXd::Map(x_.data(), size), {}};
  // A motion may be beyond a section for the moment at which it is reset alone.
  std::vector<double> now(model_.signals.size());
  const auto look_at = [&](double share, const HeldMotion& at) {
    held_.signals(moment_at(share).data(), at.state.data(), now.data());
    look_at_section(now, time_ + share * length);
  };
  const auto look = [&](double from, double to, const HeldMotion& before, const HeldMotion& after) {
    if (from > 0.0) look_at(from, before);
    look_at(to, after);
    // Steps that are as long as several returns would see a level at one place alone.
    look_at_levels(moment_at(to).data(), after.state.data(), stretch);
  };
  held_step_.take(moment_at, &motion, look);
  end->assign(motion.state.begin(), motion.state.end());
  return true;
}

std::vector<double> ProbeMotion::step(const StepMoments& moment_at, double begin, double end,
                                      const std::vector<double>& from) {
  HeldMotion motion{Eigen::VectorXd::Map(from.data(), static_cast<Eigen::Index>(from.size())), {}};
  held_step_.carry(moment_at, begin, end, &motion);
  return {motion.state.begin(), motion.state.end()};
}

ProbeMotion::Trial ProbeMotion::attempt(const Stretch& stretch, double length) {
  const StepMoments moment_at = moments_of(length);
  const std::vector<double> whole = step(moment_at, 0.0, 1.0, x_);
  Trial trial;
  trial.middle = step(moment_at, 0.0, 0.5, x_);
  trial.end = step(moment_at, 0.5, 1.0, trial.middle);
  if (!is_finite(whole) || !is_finite(trial.end)) {
    trial.excess = std::numeric_limits<double>::infinity();
    return trial;
  }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    // Two halves have a sixteenth of the error of the whole.
    const double error = std::abs(whole[i] - trial.end[i]) * 16.0 / 15.0;
    const double range =
        std::max(stretch.high[i], trial.end[i]) - std::min(stretch.low[i], trial.end[i]);
    trial.errors.push_back(error);
    if (range > stretch.rounding[i]) trial.excess = std::max(trial.excess, error / range);
  }
  return trial;
}

bool ProbeMotion::hides_something(const Stretch& stretch, const Trial& trial, double length) {
  constexpr double kFar = 8.0;  // times what the slopes at the moments make of the way
  if (!reach_ || halvings_left_ == 0) return false;
  const std::size_t states = x_.size();
  std::vector<double> low = x_, high = x_, slopes(states * states), largest(states * states);
  const std::vector<double> coefs = coefs_at(phase_);
  for (const std::vector<double>* at : std::array{&std::as_const(x_), &trial.middle, &trial.end}) {
    for (std::size_t i = 0; i < states; ++i) {
      low[i] = std::min(low[i], (*at)[i]);
      high[i] = std::max(high[i], (*at)[i]);
    }
    point_->jacobian(coefs.data(), at->data(), slopes.data());
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      largest[i] = std::max(largest[i], std::abs(slopes[i]));
    }
  }
  const std::vector<double> ranges = reach_->rate_ranges(low, high);
  for (std::size_t i = 0; i < states; ++i) {
    double seen = 0.0;
    for (std::size_t j = 0; j < states; ++j) seen += largest[i * states + j] * (high[j] - low[j]);
    const double range = std::max(stretch.high[i], high[i]) - std::min(stretch.low[i], low[i]);
    if (ranges[i] * length > kMaxError * range && ranges[i] > kFar * seen) return true;
  }
  return false;
}

bool ProbeMotion::may_bend(const Trial& trial, double length, double end_phase) {
  if (is_rough_ || crosses_limit(trial.middle, phase_ + 0.5 * length / period_) ||
      crosses_limit(trial.end, std::min(end_phase, 1.0))) {
    return true;
  }
  if (model_.surfaces.empty()) return false;
  std::vector<double> end = trial.end;
  const StepMoments moment_at = moments_of(length);
  held_.put_back(moment_at(1.0).data(), end.data());
  return held_.left_behind(moment_at(1.0).data(), end.data()).has_value();
}

bool ProbeMotion::crosses_limit(const std::vector<double>& end, double end_phase) const {
  const std::vector<ContactLimit> limits = model_.contact_limits();
  if (limits.empty()) return false;
  // Deflection and backlash of each contact and corner.
  std::vector<double> before(2 * (model_.contacts.size() + model_.corners)), after(before.size());
  point_->contact_places(coefs_at(phase_).data(), x_.data(), before.data());
  point_->contact_places(coefs_at(end_phase).data(), end.data(), after.data());
  return std::ranges::any_of(limits, [&](const ContactLimit& limit) {
    const auto touches = [&](const std::vector<double>& places) {
      return limit.flank * places[2 * limit.contact] > places[2 * limit.contact + 1];
    };
    return touches(before) != touches(after);
  });
}

}  // namespace gearsweep
