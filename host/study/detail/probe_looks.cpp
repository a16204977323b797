// What a pilot looks at on the way, and what that tells of a step.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "model/eigenvalues.hpp"
#include "study/detail/probe_motion.hpp"

namespace gearsweep {
namespace {

// Terms of this size and more, in roundings, stand out from them.
constexpr double kStandsOut = 1e6 * std::numeric_limits<double>::epsilon();
// A share of the above: an error that is no more than ten roundings tells nothing.
constexpr double kNoise = 1e-5;

}  // namespace

double ProbeMotion::Stretch::step_of(double local_error) const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Step& step : steps) {
    for (std::size_t i = 0; i < low.size(); ++i) {
      const double range = high[i] - low[i];
      if (range <= rounding[i] || step.errors[i] <= kNoise * rounding[i]) continue;
      longest =
          std::min(longest, step.length * std::pow(local_error * range / step.errors[i], 0.2));
    }
  }
  return longest;
}

double ProbeMotion::Stretch::level_time(const Model& model) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < level_speeds.size(); ++k) {
    const double range = high_levels[k] - low_levels[k];
    if (rests[k] || !(range > kStandsOut * level_sizes[k] && level_speeds[k] > 0.0)) continue;
    const double way = model.surfaces[k].is_staircase ? std::min(range, 1.0) : range;
    shortest = std::min(shortest, way / level_speeds[k]);
  }
  return shortest;
}

void ProbeMotion::look_at_signals(Stretch* stretch) {
  std::vector<double> now(model_.signals.size());
  if (now.empty()) return;
  point_->signals(coefs_at(phase_).data(), x_.data(), now.data());
  look_at_section(now, time_);
  if (stretch->low_signals.empty()) stretch->low_signals = stretch->high_signals = now;
  for (std::size_t i = 0; i < now.size(); ++i) {
    stretch->low_signals[i] = std::min(stretch->low_signals[i], now[i]);
    stretch->high_signals[i] = std::max(stretch->high_signals[i], now[i]);
  }
}

// A level along which the motion slides is rounding.
void ProbeMotion::look_at_levels(const double* coefs, const double* x, Stretch* stretch) {
  if (model_.surfaces.empty()) return;
  const HeldField::Levels now = held_.levels(coefs, x);
  if (stretch->level_speeds.empty()) {
    stretch->low_levels = stretch->high_levels = now.value;
    stretch->level_speeds.assign(now.value.size(), 0.0);
    stretch->level_sizes.assign(now.value.size(), 0.0);
    stretch->rests.assign(now.value.size(), false);
  }
  for (std::size_t k = 0; k < now.value.size(); ++k) {
    if (held_.slides(k)) {
      stretch->rests[k] = stretch->rests[k] || model_.surfaces[k].resets;
      continue;
    }
    if (!std::isfinite(now.value[k]) || !std::isfinite(now.rate[k])) continue;
    stretch->low_levels[k] = std::min(stretch->low_levels[k], now.value[k]);
    stretch->high_levels[k] = std::max(stretch->high_levels[k], now.value[k]);
    stretch->level_speeds[k] = std::max(stretch->level_speeds[k], std::abs(now.rate[k]));
    stretch->level_sizes[k] = std::max(stretch->level_sizes[k], now.size[k]);
  }
}

void ProbeMotion::look_at_peaks(const Stretch& stretch, double length) {
  if (peaks_.empty()) return;
  std::vector<double> rates(x_.size());
  held_.rhs(coefs_at(phase_).data(), x_.data(), rates.data());
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    Peaks& peaks = peaks_[i];
    if (peaks.rate > 0.0 && rates[i] <= 0.0) {
      if (peaks.count == 0) peaks.first = time_;
      ++peaks.count;
      peaks.last = time_;
      peaks.turns += (peaks.rate - rates[i]) / length;
    }
    peaks.rate = rates[i];
    peaks.fastest = std::max(peaks.fastest, std::abs(rates[i]));
    peaks.low = peaks.count == 0 ? x_[i] : std::min(peaks.low, x_[i]);
    peaks.high = peaks.count == 0 ? x_[i] : std::max(peaks.high, x_[i]);
    peaks.rounding = stretch.rounding[i];
  }
}

std::vector<bool> ProbeMotion::has_peaks() const {
  constexpr double kTurn = 0.05;  // of 2 pi of a sine
  std::vector<bool> out;
  for (const Peaks& peaks : peaks_) {
    const auto count = static_cast<double>(peaks.count);
    const double apart = (peaks.last - peaks.first) / (count - 1.0);
    out.push_back(peaks.count > 2 && peaks.high - peaks.low > peaks.rounding &&
                  peaks.turns / count * apart > kTurn * peaks.fastest);
  }
  return out;
}

void ProbeMotion::look_at_section(const std::vector<double>& signals, double time) {
  if (model_.sections.empty()) return;
  const double level = signals[model_.sections.front().level];
  if (level_ < 0.0 && level >= 0.0) returns_.push_back(time);
  level_ = level;
}

bool ProbeMotion::has_finite_rates() const {
  const std::size_t states = x_.size();
  const std::vector<double> coefs = coefs_at(phase_);
  std::vector<double> all(states + states * states);
  point_->rhs(coefs.data(), x_.data(), all.data());
  point_->jacobian(coefs.data(), x_.data(), all.data() + states);
  return std::ranges::all_of(all, [](double value) { return std::isfinite(value); });
}

// What rounding may leave of a state: of itself, and of the terms of its rate over the time in
// which the motion changes.
void ProbeMotion::look_at_rates(Stretch* stretch) const {
  const std::size_t states = x_.size();
  std::vector<double> jacobian(states * states);
  point_->jacobian(coefs_at(phase_).data(), x_.data(), jacobian.data());
  if (!std::ranges::all_of(jacobian, [](double slope) { return std::isfinite(slope); })) return;
  double rate = 0.0;
  for (const std::complex<double>& value : eigenvalues(jacobian.data(), states)) {
    rate = std::max(rate, std::abs(value));
  }
  if (stretch->rate == 0.0) stretch->first_rate = rate;
  stretch->rate = std::max(stretch->rate, rate);
  for (std::size_t i = 0; i < states; ++i) {
    double size = std::abs(x_[i]);
    for (std::size_t j = 0; j < states && rate > 0.0; ++j) {
      size = std::max(size, std::abs(jacobian[i * states + j] * x_[j]) / rate);
    }
    stretch->rounding[i] = std::max(stretch->rounding[i], kStandsOut * size);
  }
}

}  // namespace gearsweep
