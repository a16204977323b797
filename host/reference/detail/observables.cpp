#include "reference/detail/observables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/orbit_observables.hpp"
#include "reference/detail/step_curve.hpp"
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

// Of a channel, or of anything else that a moment has.
template <class Value>
StepCurve curve_of(const TrajectoryStep& step, const Value& value) {
  std::optional<double> earlier;
  if (step.earlier) earlier = value(*step.earlier);
  return {value(step.before), value(step.middle), value(step.after), earlier};
}

class Extrema final : public ReferenceObservable {
 public:
  explicit Extrema(const Channel& channel) : channel_(channel) {}
  void step(const TrajectoryStep& step) override {
    for (const Moment* moment : {&step.before, &step.middle, &step.after}) see(channel_(*moment));
    if (step.is_smooth) see_inside(step);
  }
  std::vector<double> finish(const Window&) const override { return {min_, max_, max_ - min_}; }

 private:
  void see(double value) {
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }

  void see_inside(const TrajectoryStep& step) {
    const StepCurve curve = curve_of(step, channel_);
    if (const std::optional<double> t = curve.extremum()) see(curve.value(*t));
  }

  Channel channel_;
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

// Weighted mean and variance by West's recurrence (Communications of the ACM 22, 1979): each step
// gives its share to its ends and its middle, by Simpson's rule.
class Moments final : public ReferenceObservable {
 public:
  explicit Moments(const Channel& channel) : channel_(channel) {}
  void step(const TrajectoryStep& step) override {
    add(channel_(step.before), step.share / 6.0);
    add(channel_(step.middle), step.share * 4.0 / 6.0);
    add(channel_(step.after), step.share / 6.0);
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

class Contact final : public ReferenceObservable {
 public:
  Contact(const Model& model, const ContactInfo& contact)
      : deflection_(model, model.signals[contact.deflection].name),
        backlash_(model, model.signals[contact.backlash].name),
        is_one_sided_(contact.is_one_sided) {}

  void step(const TrajectoryStep& step) override {
    const Moment& before = step.before;
    const Moment& after = step.after;
    const Touch drive = touch(step, 1.0);
    const Touch back = is_one_sided_ ? Touch{} : touch(step, -1.0);
    const double sum = drive.share + back.share;
    const bool opposite = drive.at_start != back.at_start && drive.at_end != back.at_end;
    const double both = opposite ? std::max(0.0, sum - 1.0) : std::min(drive.share, back.share);
    drive_ += step.share * (drive.share - both);
    back_ += step.share * (back.share - both);
    wedged_ += step.share * both;
    losses_ += drive.losses + back.losses;
    // Without a backlash a gap between the flanks is rounding.
    const bool open = is_one_sided_ || std::max(backlash_(before), backlash_(after)) > 0.0;
    const double touching = sum - both;
    if (touching <= 0.0 || (open && touching < 1.0)) seen_gap_ = true;
    if (is_one_sided_) return;
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
  // What a flank does during a step.
  struct Touch {
    bool at_start = false, at_end = false;
    double share = 0.0, losses = 0.0;
  };
  Touch touch(const TrajectoryStep& step, double flank) const {
    const StepCurve depth =
        curve_of(step, [&](const Moment& moment) { return beyond(moment, flank); });
    Touch out;
    out.at_start = beyond(step.before, flank) > 0.0;
    out.at_end = beyond(step.after, flank) > 0.0;
    std::vector<double> places = {-1.0};
    if (const std::optional<double> turn = depth.extremum()) places.push_back(*turn);
    places.push_back(1.0);
    const auto is_on = [&](std::size_t i) {
      return i == 0                   ? out.at_start
             : i + 1 == places.size() ? out.at_end
                                      : depth.value(places[i]) > 0.0;
    };
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double from = places[i], to = places[i + 1];
      if (is_on(i) == is_on(i + 1)) {
        if (is_on(i)) out.share += 0.5 * (to - from);
        continue;
      }
      const double zero = depth.zero(from, to);
      out.share += 0.5 * (is_on(i) ? zero - from : to - zero);
      if (is_on(i)) ++out.losses;
    }
    return out;
  }

  // How far the deflection is beyond the limit of a flank, 1 (drive) or -1 (back).
  double beyond(const Moment& moment, double flank) const {
    return flank * deflection_(moment) - backlash_(moment);
  }

  Channel deflection_, backlash_;
  bool is_one_sided_;
  double drive_ = 0.0, back_ = 0.0, wedged_ = 0.0, losses_ = 0.0;
  double min_backlash_ = std::numeric_limits<double>::infinity();
  bool seen_gap_ = false;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_observable(const Model& model, const Observer& observer,
                                                     double period_tolerance) {
  const std::string& kind = observer.observable->name;
  if (kind == "extrema") return std::make_unique<Extrema>(Channel(model, observer.part));
  if (kind == "moments") return std::make_unique<Moments>(Channel(model, observer.part));
  if (kind == "contact") {
    const auto contact = std::ranges::find(model.contacts, observer.part, &ContactInfo::name);
    return std::make_unique<Contact>(model, *contact);
  }
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
