#include "reference/detail/orbit_observables.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/detail/lyapunov_observables.hpp"

namespace gearsweep {
namespace {

// By how much what does not recur must miss, in terms of what does (kernels/observables/period.h).
constexpr double kClear = 100.0;
// A section that grows so many times from one half of the record to the other has no bounds.
constexpr double kRunaway = 100.0;

// The period with which the sections recur, 0: none; and the section from which on they do.
struct Recurrence {
  std::size_t period = 0, since = 0;
};

// The sections of a record: where it begins, and at the end of each period.
class Sections {
 public:
  Sections(double tolerance, const StateKinds& kinds)
      : tolerance_(tolerance), range_(kinds, tolerance) {}
  void begin(const Eigen::VectorXd& state) {
    states_.push_back(state);
    range_.begin(state);
  }
  // A moment between two sections.
  void pass(const Eigen::VectorXd& state) { range_.widen(state); }
  void add(const Eigen::VectorXd& state) {
    states_.push_back(state);
    range_.end_period(state);
  }
  // The periods recorded, which is also the number of the last section.
  std::size_t last() const { return states_.size() - 1; }

  // At each reference from some section on, the multiples of the period recur and nothing between
  // them does; no two periods can do so. It counts when two multiples do or more, and for a quarter
  // of the record, and when what is between them misses by far more than they do.
  Recurrence recurrence() const {
    for (std::size_t period = 1; period <= longest_window() / 2; ++period) {
      const Stretch stretch = final_stretch(period);
      if (stretch.recurrences >= 2 && 4 * (last() - stretch.since) >= last()) {
        if (stretch.nearest < kClear * stretch.worst) return {};
        return {period, stretch.since};
      }
    }
    return {};
  }

  // The box of the sections from `first` to `final`: its longest side, relative to the ranges; 0
  // where a motion that diverged has no such sections.
  double extent(std::size_t first, std::size_t final) const {
    if (first > final || last() == 0) return 0.0;
    Eigen::ArrayXd min = states_[first], max = states_[first];
    for (std::size_t i = first; i <= final; ++i) {
      min = min.min(states_[i].array());
      max = max.max(states_[i].array());
    }
    return range_.size((max - min).matrix());
  }

 private:
  // A section that others are compared with, up to the last of its window.
  struct Reference {
    std::size_t section, window_end;
  };
  // How often sections recurred, and since which reference; the largest distance among those that
  // did, the smallest among the others.
  struct Stretch {
    std::size_t recurrences = 0, since = 0;
    double worst = 0.0, nearest = std::numeric_limits<double>::infinity();
  };

  std::size_t longest_window() const {
    return std::max(std::size_t{64}, std::bit_floor(last() / 3));
  }

  std::vector<Reference> references() const {
    std::vector<Reference> references;
    std::size_t window = 1;
    for (std::size_t section = 0; section < last(); section = references.back().window_end) {
      references.push_back({section, std::min(section + window, last())});
      window = std::min(2 * window, longest_window());
    }
    return references;
  }

  double distance(std::size_t i, std::size_t j) const {
    return range_.distance(states_[i], states_[j]);
  }

  // The stretch with a window before it; nothing when one of the multiples of the period is not the
  // same as the reference, or when another section is that a period could bring back.
  std::optional<Stretch> with(const Reference& reference, std::size_t period,
                              Stretch stretch) const {
    for (std::size_t i = reference.section + 1; i <= reference.window_end; ++i) {
      const std::size_t lag = i - reference.section;
      const bool is_multiple = lag % period == 0;
      if (!is_multiple && lag > longest_window() / 2) continue;
      const double apart = distance(i, reference.section);
      if ((apart <= tolerance_) != is_multiple) return std::nullopt;
      if (is_multiple) {
        ++stretch.recurrences;
        stretch.since = reference.section;
        stretch.worst = std::max(stretch.worst, apart);
      } else {
        stretch.nearest = std::min(stretch.nearest, apart);
      }
    }
    return stretch;
  }

  // The last references from which on the period recurs throughout.
  Stretch final_stretch(std::size_t period) const {
    const std::vector<Reference> all = references();
    Stretch stretch;
    for (auto reference = all.rbegin(); reference != all.rend(); ++reference) {
      const std::optional<Stretch> longer = with(*reference, period, stretch);
      if (!longer) break;
      stretch = *longer;
    }
    return stretch;
  }

  double tolerance_;
  MotionRange range_;
  std::vector<Eigen::VectorXd> states_;
};

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
  const Sections& sections() const { return sections_; }

 private:
  Sections sections_;
};

class Period final : public SectionObservable {
 public:
  using SectionObservable::SectionObservable;
  std::vector<double> finish(const Window&) const override {
    return {static_cast<double>(sections().recurrence().period)};
  }
};

class Settled final : public SectionObservable {
 public:
  using SectionObservable::SectionObservable;
  std::vector<double> finish(const Window& window) const override {
    const Recurrence found = sections().recurrence();
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
    if (sections().recurrence().period > 0) return log_stretching > error ? undecided : periodic;
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
