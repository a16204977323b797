#include "reference/detail/contact_observables.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "reference/detail/channel.hpp"

namespace gearsweep {
namespace {

// One limit of a contact: flank 1 (drive) or -1 (back).
class Flank {
 public:
  Flank(const Channel& deflection, const Channel& backlash, double flank)
      : deflection_(deflection), backlash_(backlash), flank_(flank) {}

  // What it does during a step. Speeds are those at which it is regained, per period.
  struct Touch {
    bool at_start = false, at_end = false;
    double share = 0.0, losses = 0.0;
    std::vector<double> speeds = {};
  };
  Touch touch(const TrajectoryStep& step) const {
    const StepCurve depth = curve(step);
    Touch out;
    out.at_start = beyond(step.before) > 0.0;
    out.at_end = beyond(step.after) > 0.0;
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
      if (is_on(i)) {
        ++out.losses;
      } else {
        out.speeds.push_back(depth.slope(zero) * 2.0 / step.share);
      }
    }
    return out;
  }

  StepCurve curve(const TrajectoryStep& step) const {
    return curve_of(step, [this](const Instant& moment) { return beyond(moment); });
  }
  // How far the deflection is beyond the limit.
  double beyond(const Instant& moment) const {
    return flank_ * deflection_(moment) - backlash_(moment);
  }

 private:
  Channel deflection_, backlash_;
  double flank_;
};

class Contact final : public ReferenceObservable {
 public:
  Contact(const Model& model, const ContactInfo& contact)
      : deflection_(model, model.signals[contact.deflection].name),
        backlash_(model, model.signals[contact.backlash].name),
        is_one_sided_(contact.is_one_sided) {}

  void step(const TrajectoryStep& step) override {
    const Instant& before = step.before;
    const Instant& after = step.after;
    using Touch = Flank::Touch;
    const Touch drive = Flank(deflection_, backlash_, 1.0).touch(step);
    const Touch back = is_one_sided_ ? Touch{} : Flank(deflection_, backlash_, -1.0).touch(step);
    const double sum = drive.share + back.share;
    const bool opposite = drive.at_start != back.at_start && drive.at_end != back.at_end;
    const double both = opposite ? std::max(0.0, sum - 1.0) : std::min(drive.share, back.share);
    drive_ += step.weight * (drive.share - both);
    back_ += step.weight * (back.share - both);
    wedged_ += step.weight * both;
    losses_ += step.once * (drive.losses + back.losses);
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
  Channel deflection_, backlash_;
  bool is_one_sided_;
  double drive_ = 0.0, back_ = 0.0, wedged_ = 0.0, losses_ = 0.0;
  double min_backlash_ = std::numeric_limits<double>::infinity();
  bool seen_gap_ = false;
};

class ContactImpacts final : public ReferenceObservable {
 public:
  ContactImpacts(const Model& model, const ContactInfo& contact) {
    const Channel deflection(model, model.signals[contact.deflection].name);
    const Channel backlash(model, model.signals[contact.backlash].name);
    flanks_.push_back({Flank(deflection, backlash, 1.0)});
    if (!contact.is_one_sided) flanks_.push_back({Flank(deflection, backlash, -1.0)});
  }

  void step(const TrajectoryStep& step) override {
    for (Seen& seen : flanks_) {
      for (const double speed : seen.flank.touch(step).speeds) {
        seen.impacts += step.once;
        period_speed_ = std::max(period_speed_, speed);
      }
      for (const Instant* moment : {&step.before, &step.middle, &step.after}) {
        seen.depth = std::max(seen.depth, seen.flank.beyond(*moment));
      }
      if (!step.is_smooth) continue;
      const StepCurve curve = seen.flank.curve(step);
      if (const auto t = curve.extremum()) seen.depth = std::max(seen.depth, curve.value(*t));
    }
  }
  void period(const Eigen::VectorXd&, const Eigen::VectorXd&, double length) override {
    speed_ = std::max(speed_, period_speed_ / length);
    period_speed_ = 0.0;
  }
  std::vector<double> finish(const Window& window) const override {
    const auto count = static_cast<double>(window.record);
    double depth = 0.0;
    for (const Seen& seen : flanks_) {
      if (seen.impacts > 0.0) depth = std::max(depth, seen.depth);
    }
    const double back = flanks_.size() > 1 ? flanks_.back().impacts / count : 0.0;
    return {flanks_.front().impacts / count, back, speed_, depth};
  }

 private:
  struct Seen {
    Flank flank;
    double impacts = 0.0, depth = 0.0;
  };
  std::vector<Seen> flanks_;
  double speed_ = 0.0, period_speed_ = 0.0;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_contact(const Model& model, const ContactInfo& contact) {
  return std::make_unique<Contact>(model, contact);
}

std::unique_ptr<ReferenceObservable> make_contact_impacts(const Model& model,
                                                          const ContactInfo& contact) {
  return std::make_unique<ContactImpacts>(model, contact);
}

}  // namespace gearsweep
