// What an engineer reads out of gear5, at a moment: against the equations of motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

// A moment of a motion: the state, its rate of change and the signals.
struct SignalMoment {
  double psi;
  std::vector<double> x, dx, signals;

  double signal(const std::string& name) const { return signals[signal_index(gear5(), name)]; }
};

SignalMoment any_moment(const ModelSetting& setting, std::mt19937* random) {
  std::uniform_real_distribution<double> place(-2.0, 2.0), phase(0.01, 0.99);
  SignalMoment moment{phase(*random), std::vector<double>(10), std::vector<double>(10),
                      std::vector<double>(gear5().signals.size())};
  std::ranges::generate(moment.x, [&] { return place(*random); });
  std::vector<double> coefs(gear5().phase_coefs.size());
  gear5().phase_coefs_at(setting, moment.psi, moment.psi, coefs.data());
  const std::unique_ptr<PreparedPoint> point = gear5().prepare(setting);
  point->rhs(coefs.data(), moment.x.data(), moment.dx.data());
  point->signals(coefs.data(), moment.x.data(), moment.signals.data());
  return moment;
}

ModelSetting any_gear(std::mt19937* random) {
  std::uniform_real_distribution<double> factor(0.5, 1.5);
  ModelSetting setting = gear5().default_setting();
  for (const char* name :
       {"mu", "e0", "m1", "m2", "k1", "k2", "k3", "k4", "c1", "c2", "c3", "c4"}) {
    set_parameter(&setting, name, parameter_of(setting, name) * factor(*random));
  }
  set_option(&setting, "backlash", (*random)() % 2 == 0 ? "constant" : "dynamic");
  set_option(&setting, "formulation", (*random)() % 2 == 0 ? "consistent" : "printed");
  return setting;
}

// A shaft's mass times its acceleration is what the mesh does less what the bearing does.
TEST(Gear5Signals, BearingForcesAreWhatTheAccelerationsLackOfTheMeshForces) {
  std::mt19937 random(20261125);
  for (int i = 0; i < 200; ++i) {
    const ModelSetting setting = any_gear(&random);
    const SignalMoment at = any_moment(setting, &random);
    const double sign = option_of(setting, "formulation") == "printed" ? 1.0 : -1.0;
    const double rate = at.x[5] + sign * (at.x[7] - at.x[9]);
    const double b = at.signal("backlash"), deflection = at.signal("deflection");
    const double f = std::max(deflection - b, 0.0) + std::min(deflection + b, 0.0);
    const double normal =
        at.signal("mesh_stiffness") * f + 4.0 * parameter_of(setting, "zeta") * rate;
    const double m1 = parameter_of(setting, "m1"), m2 = parameter_of(setting, "m2");
    EXPECT_NEAR(at.signal("bearing_p"),
                std::hypot(-at.dx[6] / m1 - at.signal("friction"), normal - at.dx[7] / m1), 1e-12);
    EXPECT_NEAR(at.signal("bearing_g"),
                std::hypot(at.signal("friction") - at.dx[8] / m2, -normal - at.dx[9] / m2), 1e-12);
  }
}

// x1 is Rp theta_p - Rg theta_g - e(t).
TEST(Gear5Signals, DynamicTransmissionErrorHasTheErrorOfTheTeeth) {
  std::mt19937 random(20261126);
  for (int i = 0; i < 50; ++i) {
    const ModelSetting setting = any_gear(&random);
    const SignalMoment at = any_moment(setting, &random);
    const double error = parameter_of(setting, "e0") * std::sin(2.0 * std::numbers::pi * at.psi);
    EXPECT_NEAR(at.signal("dte"), at.x[0] + error, 1e-14);
  }
}

// Force times velocity: of all that a damper or friction makes of the accelerations, on x1 and on
// the masses 1/m of the shafts. Both forces are linear in zeta and mu.
TEST(Gear5Signals, PowersAreWhatDampersAndFrictionTakeFromTheMotion) {
  std::mt19937 random(20261127);
  for (int i = 0; i < 100; ++i) {
    const ModelSetting setting = any_gear(&random);
    std::mt19937 same = random;
    const SignalMoment at = any_moment(setting, &random);
    const double m1 = parameter_of(setting, "m1"), m2 = parameter_of(setting, "m2");
    const auto power_without = [&](const char* parameter, ModelSetting changed) {
      set_parameter(&changed, parameter, 0.0);
      std::mt19937 again = same;
      const SignalMoment without = any_moment(changed, &again);
      double power = 0.0;
      for (std::size_t v = 5; v < 10; ++v) {
        const double mass = v == 5 ? 1.0 : v < 8 ? 1.0 / m1 : 1.0 / m2;
        power -= mass * (at.dx[v] - without.dx[v]) * at.x[v];
      }
      return power;
    };
    EXPECT_NEAR(at.signal("power_friction"), power_without("mu", setting), 1e-11);
    EXPECT_NEAR(at.signal("power_damping"),
                power_without("zeta", setting) -
                    (at.signal("power_friction") -
                     [&] {
                       ModelSetting undamped = setting;
                       set_parameter(&undamped, "zeta", 0.0);
                       std::mt19937 again = same;
                       return any_moment(undamped, &again).signal("power_friction");
                     }()),
                1e-11);
  }
}

}  // namespace
}  // namespace gearsweep::testing
