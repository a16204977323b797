#include "reference/detail/observables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "model/error.hpp"
#include "reference/detail/channel.hpp"
#include "reference/detail/contact_observables.hpp"
#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/orbit_observables.hpp"
#include "reference/detail/section_observables.hpp"
#include "reference/detail/state_moments.hpp"
#include "reference/detail/surface_observables.hpp"
#include "reference/detail/zero_one_observable.hpp"

namespace gearsweep {
namespace {

class Extrema final : public ReferenceObservable {
 public:
  explicit Extrema(const Channel& channel) : channel_(channel) {}
  void step(const TrajectoryStep& step) override {
    for (const Instant* moment : {&step.before, &step.middle, &step.after}) see(channel_(*moment));
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
// gives its weight to its ends and its middle, by Simpson's rule.
class Moments final : public ReferenceObservable {
 public:
  explicit Moments(const Channel& channel) : channel_(channel) {}
  void step(const TrajectoryStep& step) override {
    add(channel_(step.before), step.weight / 6.0);
    add(channel_(step.middle), step.weight * 4.0 / 6.0);
    add(channel_(step.after), step.weight / 6.0);
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

// The complex Fourier integral, with the whole angle at each moment, by Simpson's rule.
class Orders final : public ReferenceObservable {
 public:
  Orders(const Channel& channel, const std::vector<double>& orders, double mesh_periods)
      : channel_(channel), mesh_periods_(mesh_periods), orders_(orders), sums_(orders.size()) {}

  void step(const TrajectoryStep& step) override {
    if (!first_) first_ = channel_(step.before);
    add(step.before, psi_, step.share / 6.0);
    add(step.middle, psi_ + 0.5 * step.share, step.share * 4.0 / 6.0);
    psi_ += step.share;
    add(step.after, psi_, step.share / 6.0);
  }
  void period(const Eigen::VectorXd&, const Eigen::VectorXd&, double) override {
    periods_ += 1.0;
    psi_ = 0.0;
  }
  std::vector<double> finish(const Window&) const override {
    std::vector<double> out;
    for (const std::complex<double>& sum : sums_) out.push_back(2.0 * std::abs(sum) / periods_);
    for (const std::complex<double>& sum : sums_) out.push_back(std::arg(sum));
    return out;
  }

 private:
  void add(const Instant& moment, double psi, double weight) {
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const double turns = orders_[i] * mesh_periods_ * (periods_ + psi);
      sums_[i] +=
          weight * (channel_(moment) - *first_) * std::polar(1.0, -2.0 * std::numbers::pi * turns);
    }
  }

  Channel channel_;
  double mesh_periods_;
  std::vector<double> orders_;
  std::optional<double> first_;
  double psi_ = 0.0, periods_ = 0.0;
  std::vector<std::complex<double>> sums_;
};

// For tori and chaos where there is no clock: not in the plane, unless resets or angles fold it.
bool has_room(const Model& model) {
  const bool resets = std::ranges::any_of(model.surfaces, &SurfaceInfo::resets);
  return model.states.size() > (resets ? 1U : 2U) || model.angles.size() > 1;
}

}  // namespace

std::unique_ptr<ReferenceObservable> make_observable(const Study& study,
                                                     const ModelSetting& setting,
                                                     const Observer& observer) {
  const Model& model = *study.model;
  const double period_tolerance = study.selection.period_tolerance;
  const std::string& kind = observer.observable->name;
  const StateKinds kinds = {model.range_groups, model.angles, model.clocks > 0};
  if (kind == "extrema") return std::make_unique<Extrema>(Channel(model, observer.part));
  if (kind == "moments") return std::make_unique<Moments>(Channel(model, observer.part));
  if (kind == "orders") {
    return std::make_unique<Orders>(Channel(model, observer.part), study.selection.orders,
                                    model.mesh_periods(setting));
  }
  if (observer.observable->part == ObservedPart::contact) {
    const auto contact = std::ranges::find(model.contacts, observer.part, &ContactInfo::name);
    if (kind == "contact") return make_contact(model, *contact);
    if (kind == "contact_impacts") return make_contact_impacts(model, *contact);
  }
  if (kind == "sticking") return make_sticking();
  if (kind == "surface_impacts") {
    const auto surface = std::ranges::find(model.surfaces, observer.part, &SurfaceInfo::name);
    return make_surface_impacts(static_cast<std::size_t>(surface - model.surfaces.begin()));
  }
  if (observer.observable->part == ObservedPart::section) {
    const auto section = std::ranges::find(model.sections, observer.part, &SectionInfo::name);
    if (kind == "returns") return make_returns(*section);
    if (kind == "cycle") return make_cycle(*section, period_tolerance, kinds);
    if (kind == "return_motion") {
      return make_return_motion(*section, period_tolerance, kinds, has_room(model));
    }
  }
  if (kind == "lyapunov_max") return make_lyapunov_max(model.is_clockless);
  if (kind == "lyapunov_spectrum") return make_lyapunov_spectrum(model.is_clockless);
  if (kind == "kaplan_yorke") return make_kaplan_yorke(model);
  if (kind == "period") return make_period(period_tolerance, kinds);
  if (kind == "settled") return make_settled(period_tolerance, kinds);
  if (kind == "motion") return make_motion(period_tolerance, kinds);
  if (kind == "section") return make_section();
  if (kind == "state_moments") return make_state_moments(model);
  if (kind == "zero_one") return make_zero_one(period_tolerance, kinds);
  throw RunError(fmt::format("the reference engine does not compute observable '{}'", kind));
}

}  // namespace gearsweep
