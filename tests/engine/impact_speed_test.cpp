// How fast the speed of the hardest impact goes to its limit as steps become shorter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

struct ImpactSetting {
  double omega, b, z, Fm, Fte, k;
  double x, v;  // at phase 0
};

// x'' = Fm + omega^2 Fte cos(omega t) - 2 z x' - (1 - k cos(omega t)) f(x), written again: Fehlberg
// 7(8) steps, each edge of the backlash located by bisection and stepped on.
class ImpactOutside {
 public:
  explicit ImpactOutside(const ImpactSetting& setting)
      : setting_(setting), flank_(flank_of(setting.x)), state_{setting.x, setting.v} {}

  double hardest_of(int periods) {
    const double h = 2.0 * std::numbers::pi / setting_.omega / kSteps;
    for (int step = 0; step < periods * kSteps; ++step) advance(step * h, h);
    return hardest_;
  }

 private:
  using State = std::array<double, 2>;
  static constexpr int kSteps = 512;

  int flank_of(double x) const { return x > setting_.b ? 1 : x < -setting_.b ? -1 : 0; }

  State stepped(double t, double h) {
    const ImpactSetting& s = setting_;
    const auto slope = [this, &s](const State& at, State& out, double time) {
      const double wave = std::cos(s.omega * time);
      out[0] = at[1];
      out[1] = s.Fm + s.omega * s.omega * s.Fte * wave - 2.0 * s.z * at[1] -
               (flank_ == 0 ? 0.0 : (1.0 - s.k * wave) * (at[0] - flank_ * s.b));
    };
    State out;
    stepper_.do_step(slope, state_, t, out, h);
    return out;
  }

  void advance(double t, double left) {
    while (flank_of(stepped(t, left)[0]) != flank_) {
      double before = 0.0, after = left;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (before + after);
        (flank_of(stepped(t, middle)[0]) == flank_ ? before : after) = middle;
      }
      state_ = stepped(t, after);
      if (flank_ == 0) hardest_ = std::max(hardest_, std::abs(state_[1]));
      flank_ = flank_ == 0 ? flank_of(state_[0]) : 0;
      t += after;
      left -= after;
    }
    state_ = stepped(t, left);
  }

  ImpactSetting setting_;
  int flank_;
  State state_;
  double hardest_ = 0.0;
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
};

std::vector<ImpactSetting> random_impact_settings(std::size_t count) {
  std::mt19937 random(20261125);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<ImpactSetting> settings;
  for (std::size_t i = 0; i < count; ++i) {
    ImpactSetting one{};
    one.omega = between(0.5, 1.5);
    one.b = between(0.2, 1.0);
    one.z = between(0.02, 0.1);
    one.Fm = between(0.0, 0.2);
    one.Fte = between(0.1, 0.5);
    one.k = between(0.0, 0.4);
    one.x = between(-1.5, 1.5);
    one.v = between(-1.0, 1.0);
    settings.push_back(one);
  }
  return settings;
}

constexpr int kImpactPeriods = 6;

SweepResult impact_speeds(const std::vector<ImpactSetting>& settings, int periods, int steps) {
  std::string study =
      "[model]\nname = 'gear1'\n[parameters]\nFte_2 = 0.0\nFte_3 = 0.0\nk_2 = 0.0\nk_3 = 0.0\n"
      "[points]\nnames = ['omega', 'b', 'z', 'Fm', 'Fte', 'k', 'x', 'v']\nnumbers = '''\n";
  for (const ImpactSetting& s : settings) {
    study +=
        fmt::format("{} {} {} {} {} {} {} {}\n", s.omega, s.b, s.z, s.Fm, s.Fte, s.k, s.x, s.v);
  }
  return run(study + fmt::format("'''\n[integrate]\nsettle = 0\nrecord = {}\nstop = 'never'\n"
                                 "steps_per_period = {}\n[observe]\nquantities = "
                                 "['contact_impacts_speed']\n",
                                 periods, steps));
}

// Where the flank of stiffness k is touched at the speed v, the third derivative jumps by k v,
// which the cubic of the step cannot follow: it reads off up to k v h^2/72 too much, where the
// impact is at the step's start, and up to k v h^2/41 too little, where it is in the middle, whose
// own value is off there. In the first step of a period a parabola stands for the cubic: k v
// h^2/12.
TEST(ImpactSpeed, HasAnErrorOfSecondOrder) {
  const std::vector<ImpactSetting> settings = random_impact_settings(120);
  std::vector<double> exact;
  for (const ImpactSetting& one : settings) {
    exact.push_back(ImpactOutside(one).hardest_of(kImpactPeriods));
  }
  EXPECT_LE(std::ranges::count(exact, 0.0), 12);  // steady contact
  std::vector<double> sums;
  for (const int steps : {64, 1024}) {
    const SweepResult result = impact_speeds(settings, kImpactPeriods, steps);
    sums.push_back(0.0);
    std::size_t near = 0;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const double h = 2.0 * std::numbers::pi / settings[i].omega / steps;
      const double error = std::abs(map_of(result, "contact_impacts_speed")[i] - exact[i]);
      const double unit = (1.0 + settings[i].k) * exact[i] * h * h;
      EXPECT_LE(error, unit / 12.0) << i << " " << steps;
      near += error <= unit / 40.0 ? 1 : 0;
      sums.back() += error;
    }
    EXPECT_GE(near, settings.size() * 95 / 100) << steps;
  }
  EXPECT_NEAR(std::log2(sums[0] / sums[1]) / std::log2(1024.0 / 64.0), 2.0, 0.15);
}

// Without damping, load and error x flies at speed 1 between flanks of stiffness 1. So each impact
// has the speed 1, and among many one is near the start of its step.
TEST(ImpactSpeed, OfManyImpactsOfAFreeFlightIsOffByWhatTheCubicLeaves) {
  const ImpactSetting flight = {
      .omega = 1.0, .b = 0.7, .z = 0.0, .Fm = 0.0, .Fte = 0.0, .k = 0.0, .x = 0.1, .v = 1.0};
  for (const int steps : {64, 128}) {
    const double h = 2.0 * std::numbers::pi / steps;
    const SweepResult result = impact_speeds({flight}, 100, steps);
    const double error = map_of(result, "contact_impacts_speed")[0] - 1.0;
    EXPECT_GT(error, 0.7 * h * h / 72.0) << steps;
    EXPECT_LT(error, 1.01 * h * h / 72.0) << steps;
  }
}

}  // namespace
}  // namespace gearsweep::testing
