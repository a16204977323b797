#include "reference/detail/section_observables.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/detail/motion_judge.hpp"
#include "reference/detail/state_sequence.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

class Returns final : public ReferenceObservable {
 public:
  explicit Returns(const SectionInfo& section) : watch_(section) {}
  void step(const TrajectoryStep& step) override {
    watch_.see(step, [&](const Eigen::VectorXd&, double time) {
      times_.push_back(time);
      count_ += step.once;
    });
  }
  void period(const Eigen::VectorXd&, const Eigen::VectorXd&, double length) override {
    length_ = length;
    ++periods_;
  }
  std::vector<double> finish(const Window&) const override {
    const double each = count_ / static_cast<double>(periods_);
    if (!watch_.is_defined()) return {kNothing, kNothing, kNothing, kNothing};
    if (times_.size() < 2) return {each, kNothing, kNothing, kNothing};
    std::vector<double> between;
    for (std::size_t i = 1; i < times_.size(); ++i) between.push_back(times_[i] - times_[i - 1]);
    const auto [shortest, longest] = std::ranges::minmax(between);
    const double mean = (times_.back() - times_.front()) / static_cast<double>(between.size());
    return {each, length_ * mean, length_ * shortest, length_ * longest};
  }

 private:
  SectionWatch watch_;
  std::vector<double> times_;
  double length_ = 0.0, count_ = 0.0;
  std::size_t periods_ = 0;
};

class Cycle final : public ReferenceObservable {
 public:
  Cycle(const SectionInfo& section, double tolerance, const StateKinds& kinds)
      : watch_(section), sections_(tolerance, kinds, true) {}
  void step(const TrajectoryStep& step) override {
    watch_.see(step, [&](const Eigen::VectorXd& state, double time) {
      sections_.is_empty() ? sections_.begin(state) : sections_.add(state);
      times_.push_back(time);
    });
    if (!sections_.is_empty()) sections_.pass(step.after.state);
  }
  void period(const Eigen::VectorXd&, const Eigen::VectorXd&, double length) override {
    length_ = length;
  }
  bool is_defined() const { return watch_.is_defined(); }
  Recurrence recurrence() const { return sections_.recurrence(kLongestWindow); }
  // Whether returns lie as those of a torus do (kernels/observables/return_motion.h).
  bool fills_torus() const {
    constexpr std::size_t kEnough = 16;
    constexpr double kNear = 3e-4, kMore = 1.25;
    if (sections_.is_empty() || sections_.last() < kEnough) return false;
    const std::size_t last = sections_.last(), middle = last / 2;
    const double early = sections_.extent(0, middle), late = sections_.extent(middle + 1, last);
    const double whole = sections_.extent(0, last);
    return whole <= kMore * std::min(early, late) &&
           sections_.closest(kLongestWindow) >= kNear * whole;
  }
  std::vector<double> finish(const Window& window) const override {
    const Recurrence found = recurrence();
    if (!is_defined()) return {kNothing, kNothing, kNothing};
    if (found.period == 0) return {0.0, kNothing, kNothing};
    const std::size_t turns = (sections_.last() - found.since) / found.period;
    const double time = times_[found.since + turns * found.period] - times_[found.since];
    const double settled = static_cast<double>(window.before + window.settle) + times_[found.since];
    return {static_cast<double>(found.period), length_ * time / static_cast<double>(turns),
            length_ * settled};
  }

 private:
  static constexpr std::size_t kLongestWindow = 64;

  SectionWatch watch_;
  StateSequence sections_;
  std::vector<double> times_;
  double length_ = 0.0;
};

class ReturnMotion final : public ReferenceObservable {
 public:
  ReturnMotion(const SectionInfo& section, double tolerance, const StateKinds& kinds, bool has_room)
      : cycle_(section, tolerance, kinds),
        states_(tolerance, kinds),
        settled_(0.1 * tolerance),
        has_room_(has_room) {}
  void begin(const Eigen::VectorXd& state) override {
    states_.begin(state);
    lowest_ = highest_ = state;
  }
  void step(const TrajectoryStep& step) override {
    cycle_.step(step);
    states_.pass(step.after.state);
    lowest_ = lowest_.cwiseMin(step.after.state);
    highest_ = highest_.cwiseMax(step.after.state);
  }
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd& log_stretching,
              double length) override {
    cycle_.period(state, log_stretching, length);
    states_.add(state);
    first_.period(log_stretching, length);
    second_.period(log_stretching, length);
  }
  std::vector<double> finish(const Window& window) const override {
    return {static_cast<double>(kind(window))};
  }

 private:
  // Whether no state has changed by more than rounding.
  bool is_still() const {
    constexpr double kRoundings = 64.0 * std::numeric_limits<double>::epsilon();
    const Eigen::ArrayXd size = lowest_.array().abs().max(highest_.array().abs());
    return ((highest_ - lowest_).array() <= kRoundings * size).all();
  }
  // In an early window only what has settled beyond doubt has a kind.
  int kind(const Window& window) const {
    const int kind = kind_at_end(window);
    if (!window.is_early) return kind;
    const bool is_settled = kind == MOTION_periodic && cycle_.recurrence().worst <= settled_;
    return is_settled || (kind == MOTION_equilibrium && is_still()) ? kind : MOTION_undecided;
  }
  int kind_at_end(const Window& window) const {
    const Growth first = first_.growth(window);
    if (first.log_stretching < -std::max(first.error, 10.0)) return MOTION_equilibrium;
    if (is_still()) return first.grows() ? MOTION_undecided : MOTION_equilibrium;
    if (!cycle_.is_defined()) return MOTION_undecided;
    if (cycle_.recurrence().period > 0) return first.grows() ? MOTION_undecided : MOTION_periodic;
    if (!has_room_) return MOTION_undecided;
    const int without = motion_without_period(states_, first, window);
    if (without != MOTION_quasi_periodic) return without;
    const bool is_torus = second_.growth(window).is_neutral() && cycle_.fills_torus();
    return is_torus ? MOTION_quasi_periodic : MOTION_undecided;
  }

  Cycle cycle_;
  StateSequence states_;
  double settled_;  // recurrences that are no worse need not go on
  bool has_room_;   // for a torus, or chaos
  Eigen::VectorXd lowest_, highest_;
  GrowthWatch first_{0, false, true}, second_{1, false, true};
};

}  // namespace

double SectionWatch::level(const Instant& moment) const {
  const double level = moment.signals[static_cast<Eigen::Index>(section_.level)];
  const double size = moment.signals[static_cast<Eigen::Index>(section_.size)];
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * size;
  return std::abs(level) <= rounding ? 0.0 : level;
}

void SectionWatch::see(const TrajectoryStep& step, const Callback& came) {
  constexpr int kLooks = 4;  // so that a dip below the section is seen
  double from = 0.0, level_from = level(step.before);
  if (last_ <= 0.0 && level_from > 0.0) came(step.before.state, time_);  // it jumps up
  for (int look = 1; look <= kLooks; ++look) {
    const double to = static_cast<double>(look) / kLooks;
    const double level_to = look == kLooks ? level(step.after) : level(step.at(to));
    if (level_from <= 0.0 && level_to > 0.0) {
      double low = from, high = to;
      for (double middle = 0.5 * (low + high); low < middle && middle < high;
           middle = 0.5 * (low + high)) {
        (level(step.at(middle)) > 0.0 ? high : low) = middle;
      }
      came(step.at(high).state, time_ + high * step.share);
    }
    from = to;
    level_from = level_to;
  }
  last_ = level_from;
  is_defined_ &= std::isfinite(last_);
  time_ += step.share;
}

std::unique_ptr<ReferenceObservable> make_returns(const SectionInfo& section) {
  return std::make_unique<Returns>(section);
}
std::unique_ptr<ReferenceObservable> make_return_motion(const SectionInfo& section,
                                                        double tolerance, const StateKinds& kinds,
                                                        bool has_room) {
  return std::make_unique<ReturnMotion>(section, tolerance, kinds, has_room);
}
std::unique_ptr<ReferenceObservable> make_cycle(const SectionInfo& section, double tolerance,
                                                const StateKinds& kinds) {
  return std::make_unique<Cycle>(section, tolerance, kinds);
}

}  // namespace gearsweep
