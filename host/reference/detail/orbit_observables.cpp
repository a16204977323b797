#include "reference/detail/orbit_observables.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "reference/detail/motion_judge.hpp"
#include "reference/detail/state_sequence.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// Collects the sections.
class SectionObservable : public ReferenceObservable {
 public:
  SectionObservable(double tolerance, const StateKinds& kinds) : sections_(tolerance, kinds) {}
  void begin(const Eigen::VectorXd& state) override { sections_.begin(state); }
  void step(const TrajectoryStep& step) override { sections_.pass(step.after.state); }
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd&, double) override {
    sections_.add(state);
  }

 protected:
  const StateSequence& sections() const { return sections_; }
  Recurrence recurrence() const {
    return sections_.recurrence(std::max(std::size_t{64}, std::bit_floor(sections_.last() / 3)));
  }

 private:
  StateSequence sections_;
};

class Period final : public SectionObservable {
 public:
  using SectionObservable::SectionObservable;
  std::vector<double> finish(const Window&) const override {
    return {static_cast<double>(recurrence().period)};
  }
};

class Settled final : public SectionObservable {
 public:
  using SectionObservable::SectionObservable;
  std::vector<double> finish(const Window& window) const override {
    const Recurrence found = recurrence();
    if (found.period == 0) return {std::numeric_limits<double>::quiet_NaN()};
    return {static_cast<double>(window.before + window.settle + found.since)};
  }
};

class Motion final : public SectionObservable {
 public:
  Motion(double tolerance, const StateKinds& kinds)
      : SectionObservable(tolerance, kinds), watch_(0, kinds.has_clock, false) {}
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd& log_stretching,
              double length) override {
    SectionObservable::period(state, log_stretching, length);
    watch_.period(log_stretching, length);
  }
  std::vector<double> finish(const Window& window) const override {
    const Growth growth = watch_.growth(window);
    const int kind = recurrence().period == 0
                         ? motion_without_period(sections(), growth, window)
                         : (growth.grows() ? MOTION_undecided : MOTION_periodic);
    return {static_cast<double>(kind)};
  }

 private:
  GrowthWatch watch_;
};

class SectionBox final : public ReferenceObservable {
 public:
  void begin(const Eigen::VectorXd& state) override { min_ = max_ = state; }
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd&, double) override {
    min_ = min_.cwiseMin(state);
    max_ = max_.cwiseMax(state);
  }
  std::vector<double> finish(const Window&) const override {
    std::vector<double> box(min_.begin(), min_.end());
    box.insert(box.end(), max_.begin(), max_.end());
    return box;
  }

 private:
  Eigen::VectorXd min_, max_;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_section() { return std::make_unique<SectionBox>(); }
std::unique_ptr<ReferenceObservable> make_period(double tolerance, const StateKinds& kinds) {
  return std::make_unique<Period>(tolerance, kinds);
}
std::unique_ptr<ReferenceObservable> make_settled(double tolerance, const StateKinds& kinds) {
  return std::make_unique<Settled>(tolerance, kinds);
}
std::unique_ptr<ReferenceObservable> make_motion(double tolerance, const StateKinds& kinds) {
  return std::make_unique<Motion>(tolerance, kinds);
}

}  // namespace gearsweep
