#include "study/free_motions.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "equations/field_graph.hpp"
#include "study/detail/median.hpp"
#include "study/detail/probe_motion.hpp"
#include "study/detail/probe_starts.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kSteps = 1000;  // of a stretch of a motion

// How far the states range in a stretch, in the largest of the ranges in `widest`, which it widens.
double extent_of(const ProbeMotion::Stretch& stretch, std::vector<double>* widest) {
  widest->resize(stretch.low.size(), 0.0);
  double extent = 0.0;
  for (std::size_t i = 0; i < stretch.low.size(); ++i) {
    const double range = stretch.high[i] - stretch.low[i];
    (*widest)[i] = std::max((*widest)[i], range);
    if (range > stretch.rounding[i]) extent = std::max(extent, range / (*widest)[i]);
  }
  return extent;
}

// Stretches of a motion of a model without forcing, behind its transient.
class FreeMotion {
 public:
  FreeMotion(const Model& model, const ProbeStart& start, bool for_peaks)
      : motion_(model, start.setting, start.state), for_peaks_(for_peaks) {
    extent_of(motion_.go_on(kSteps), &widest_);
    before_ = motion_.returns().size();
    if (for_peaks) motion_.watch_peaks();
  }

  // Follows it for peaks, if they are asked for, through a few stretches, and for returns until it
  // has seen enough, or, if another motion has told, through as few.
  void follow(bool for_returns, bool has_told) {
    bool has_enough = !for_returns;
    for (int i = 0; i < kMostStretches && !motion_.escapes(); ++i) {
      const bool is_late = i >= kStretches;
      has_enough |= seen() >= kEnough || (is_late && (seen() >= kSome || has_told));
      if (has_enough && (is_late || !for_peaks_)) break;
      const ProbeMotion::Stretch stretch = motion_.go_on(kSteps);
      const double extent = extent_of(stretch, &widest_);
      if (!has_enough) ends_ = motion_.returns().size();
      // A cycle may be slow beside its steps.
      if (is_late && extent < kAtRest) break;
      if (is_late || !for_peaks_) continue;
      peaks_ = motion_.has_peaks();
      low_.resize(stretch.low.size(), std::numeric_limits<double>::infinity());
      high_.resize(stretch.low.size(), -std::numeric_limits<double>::infinity());
      last_.resize(stretch.low.size());
      for (std::size_t j = 0; j < last_.size(); ++j) {
        low_[j] = std::min(low_[j], stretch.low[j]);
        high_[j] = std::max(high_[j], stretch.high[j]);
        last_[j] = stretch.high[j] - stretch.low[j];
      }
    }
  }

  // From a return to the next, on average.
  std::optional<double> return_time() const {
    if (motion_.escapes() || ends_ < before_ + kSome) return std::nullopt;
    const double span = motion_.returns()[ends_ - 1] - motion_.returns()[before_];
    return span / static_cast<double>(ends_ - before_ - 1);
  }
  // [state]; a state that moves little at the end has swung out.
  std::vector<bool> goes_on_with_peaks() const {
    constexpr double kStill = 0.1;  // of its range
    std::vector<bool> good = peaks_;
    for (std::size_t j = 0; j < good.size(); ++j) {
      good[j] = good[j] && !motion_.escapes() && last_[j] > kStill * (high_[j] - low_[j]);
    }
    return good;
  }

 private:
  static constexpr std::size_t kEnough = 8, kSome = 2;
  static constexpr int kStretches = 8, kMostStretches = 200;
  static constexpr double kAtRest = 1e-3;  // of the ranges that the motion has had

  std::size_t seen() const { return motion_.returns().size() - before_; }

  ProbeMotion motion_;
  const bool for_peaks_;
  std::vector<double> widest_, low_, high_, last_;  // [state]: ranges; empty: none is known
  std::vector<bool> peaks_;                         // [state]
  std::size_t before_ = 0, ends_ = 0;  // returns: of the transient, and those that count
};

// The first of the states that most motions go on with peaks of, unless the one that the model's
// own section looks at is as good.
std::optional<std::size_t> better_state(const Model& model, std::vector<std::size_t> good) {
  for (const std::size_t angle : model.angles) good[angle] = 0;
  const auto is_looked_at = [&](std::size_t state) {
    return !model.field->graph.is_number(model.field->rates[state], 0.0) &&
           std::ranges::find(model.angles, state) == model.angles.end();
  };
  std::size_t own = 0;
  while (own + 1 < good.size() && !is_looked_at(own)) ++own;
  const auto best = std::ranges::max_element(good);
  if (*best == good[own]) return std::nullopt;
  return static_cast<std::size_t>(best - good.begin());
}

}  // namespace

FreeMotions look_at_free_motions(const Study& study, bool for_peaks, bool for_returns) {
  std::vector<double> times;
  std::vector<std::size_t> good(study.model->states.size(), 0);
  for (const ProbeStart& start : probe_starts(study)) {
    FreeMotion motion(*study.model, start, for_peaks);
    motion.follow(for_returns, !times.empty());
    if (const std::optional<double> time = motion.return_time()) times.push_back(*time);
    const std::vector<bool> is_good = motion.goes_on_with_peaks();
    for (std::size_t i = 0; i < is_good.size(); ++i) good[i] += is_good[i] ? 1 : 0;
  }
  FreeMotions seen;
  if (!times.empty()) seen.return_time = median_of(times);
  if (for_peaks) seen.better_state = better_state(*study.model, good);
  return seen;
}

}  // namespace gearsweep
