#include "reference/detail/orbit_observables.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/state_sequence.hpp"

namespace gearsweep {
namespace {

// A section that grows so many times from one half of the record to the other has no bounds.
constexpr double kRunaway = 100.0;

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
      : SectionObservable(tolerance, kinds), exponent_(make_lyapunov_max()) {}
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd& log_stretching,
              double length) override {
    SectionObservable::period(state, log_stretching, length);
    exponent_->period(state, log_stretching, length);
    time_ += length;
  }
  std::vector<double> finish(const Window& window) const override {
    return {static_cast<double>(kind(window))};
  }

 private:
  enum Kind { undecided, periodic, quasi_periodic, chaotic };

  Kind kind(const Window& window) const {
    const std::vector<double> exponent = exponent_->finish(window);
    const double log_stretching = exponent[0] * time_;
    const double error = 3.0 * exponent[1] * time_;
    if (recurrence().period > 0) return log_stretching > error ? undecided : periodic;
    const double early = extent(true), late = extent(false);
    // In half the record a linear growth takes half of the stretching.
    const double grown = std::min(std::exp(0.4 * log_stretching), kRunaway);
    if (log_stretching > std::max(error, 2.0) && late <= grown * early) return chaotic;
    const bool neutral = std::abs(log_stretching) <= std::max(0.01, std::min(error, 10.0));
    const bool is_long = window.is_last || window.record >= 1000;
    const double whole = sections().extent(0, sections().last());
    const bool is_steady = whole <= std::max(0.1, 1.25 * std::min(early, late));
    if (neutral && is_long && is_steady) return quasi_periodic;
    return undecided;
  }

  // The extent of the section in one half of the record.
  double extent(bool is_first) const {
    const std::size_t middle = sections().last() / 2;
    return is_first ? sections().extent(0, middle)
                    : sections().extent(middle + 1, sections().last());
  }

  std::unique_ptr<ReferenceObservable> exponent_;
  double time_ = 0.0;
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
