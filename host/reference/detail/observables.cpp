#include "reference/detail/observables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/orbit_observables.hpp"
#include "reference/detail/zero_one_observable.hpp"

namespace gearsweep {
namespace {

// Reads a state or a signal from a moment.
class Channel {
 public:
  Channel(const Model& model, const std::string& name)
      : is_state_(model.find_state(name) >= 0),
        index_(is_state_ ? model.find_state(name) : model.find_signal(name)) {}
  double operator()(const Moment& moment) const {
    return is_state_ ? moment.state[index_] : moment.signals[index_];
  }

 private:
  bool is_state_;
  Eigen::Index index_;
};

class Extrema final : public ReferenceObservable {
 public:
  explicit Extrema(const Channel& channel) : channel_(channel) {}
  void step(const Moment& before, const Moment& after, double) override {
    const auto [low, high] = std::minmax({channel_(before), channel_(after)});
    min_ = std::min(min_, low);
    max_ = std::max(max_, high);
  }
  std::vector<double> finish(const Window&) const override { return {min_, max_}; }

 private:
  Channel channel_;
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

// Weighted mean and variance by West's recurrence (Communications of the ACM 22, 1979): each step
// gives half of its share to each of its ends.
class Moments final : public ReferenceObservable {
 public:
  explicit Moments(const Channel& channel) : channel_(channel) {}
  void step(const Moment& before, const Moment& after, double share) override {
    add(channel_(before), 0.5 * share);
    add(channel_(after), 0.5 * share);
  }
  std::vector<double> finish(const Window&) const override {
    const double variance = std::max(0.0, squares_ / weight_);  // rounding may make it negative
    return {mean_, std::sqrt(mean_ * mean_ + variance), std::sqrt(variance)};
  }

 private:
  void add(double value, double weight) {
    weight_ += weight;
    const double offset = value - mean_;
    mean_ += offset * weight / weight_;
    squares_ += weight * offset * (value - mean_);
  }

  Channel channel_;
  double weight_ = 0.0, mean_ = 0.0, squares_ = 0.0;
};

// Part of a step, from one share of it to another.
struct Span {
  double from = 0.0, to = 0.0;
  double length() const { return std::max(0.0, to - from); }
  Span meet(const Span& other) const {
    return {std::max(from, other.from), std::min(to, other.to)};
  }
};

class Contact final : public ReferenceObservable {
 public:
  explicit Contact(const Model& model)
      : deflection_(model, "deflection"), backlash_(model, "backlash") {}

  void step(const Moment& before, const Moment& after, double share) override {
    const Span drive = above_zero(beyond(before, 1.0), beyond(after, 1.0));
    const Span back = above_zero(beyond(before, -1.0), beyond(after, -1.0));
    const double both = drive.meet(back).length();
    drive_ += share * (drive.length() - both);
    back_ += share * (back.length() - both);
    wedged_ += share * both;
    for (const double flank : {1.0, -1.0}) {
      if (beyond(before, flank) > 0.0 && beyond(after, flank) <= 0.0) ++losses_;
    }
    // Without a backlash a gap between the flanks is rounding.
    const bool open = std::max(backlash_(before), backlash_(after)) > 0.0;
    const double touching = drive.length() + back.length() - both;
    if (touching <= 0.0 || (open && touching < 1.0)) seen_gap_ = true;
    min_backlash_ = std::min({min_backlash_, backlash_(before), backlash_(after)});
  }

  std::vector<double> finish(const Window& window) const override {
    const auto count = static_cast<double>(window.record);
    const bool on_drive = drive_ > 0.0;
    const bool on_back = back_ > 0.0;
    double contact_class = 0.0;
    if (min_backlash_ < 0.0) {
      contact_class = 3.0;
    } else if (on_drive && on_back) {
      contact_class = 2.0;
    } else if ((on_drive || on_back) && seen_gap_) {
      contact_class = 1.0;
    }
    // Without a negative backlash both flanks touch by rounding only.
    const double wedged = min_backlash_ < 0.0 ? wedged_ : 0.0;
    const double gap = seen_gap_ ? std::max(0.0, 1.0 - (drive_ + back_ + wedged) / count) : 0.0;
    return {drive_ / count, gap, back_ / count, wedged / count, losses_ / count, contact_class};
  }

 private:
  // Where the straight line from a to b is above zero.
  static Span above_zero(double a, double b) {
    if (a <= 0.0 && b <= 0.0) return {};
    if (a > 0.0 && b > 0.0) return {0.0, 1.0};
    const double crossing = a / (a - b);
    return a > 0.0 ? Span{0.0, crossing} : Span{crossing, 1.0};
  }

  // How far the deflection is beyond the limit of a flank, 1 (drive) or -1 (back).
  double beyond(const Moment& moment, double flank) const {
    return flank * deflection_(moment) - backlash_(moment);
  }

  Channel deflection_, backlash_;
  double drive_ = 0.0, back_ = 0.0, wedged_ = 0.0, losses_ = 0.0;
  double min_backlash_ = std::numeric_limits<double>::infinity();
  bool seen_gap_ = false;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_observable(const Model& model, const Observer& observer,
                                                     double period_tolerance) {
  const std::string& kind = observer.observable->name;
  if (kind == "extrema") return std::make_unique<Extrema>(Channel(model, observer.channel));
  if (kind == "moments") return std::make_unique<Moments>(Channel(model, observer.channel));
  if (kind == "contact") return std::make_unique<Contact>(model);
  if (kind == "lyapunov_max") return make_lyapunov_max();
  if (kind == "lyapunov_spectrum") return make_lyapunov_spectrum();
  if (kind == "kaplan_yorke") return make_kaplan_yorke();
  if (kind == "period") return make_period(period_tolerance, state_kinds(model));
  if (kind == "settled") return make_settled(period_tolerance, state_kinds(model));
  if (kind == "motion") return make_motion(period_tolerance, state_kinds(model));
  if (kind == "section") return make_section();
  if (kind == "zero_one") return make_zero_one(period_tolerance, state_kinds(model));
  throw RunError(fmt::format("the reference engine does not compute observable '{}'", kind));
}

}  // namespace gearsweep
