// Which points start at an unstable equilibrium.
#include "plan/unstable_start.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "study/builtin_models.hpp"

namespace gearsweep::testing {
namespace {

// Whether the first point is.
bool is_unstable(const std::string& toml) {
  const Plan plan(read_study(toml, "test.toml"), 16);
  return plan.is_autonomous() && starts_unstable(plan, 0, plan.own_initial_state(0));
}

std::string lorenz(const std::string& rho, const std::string& initial) {
  return "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [" + rho + "]\n" + initial;
}
const std::string kShifted = "[initial]\npolicy = 'shifted'\n";

// Steady convection is stable from rho = 1 to sigma (sigma + beta + 3)/(sigma - beta - 1) = 24.74
// (Lorenz 1963); at rest, up to 1.
TEST(UnstableStarts, AreThoseOfLorenz) {
  EXPECT_TRUE(is_unstable(lorenz("28.0", kShifted)));
  EXPECT_TRUE(is_unstable(lorenz("24.8", kShifted)));
  EXPECT_FALSE(is_unstable(lorenz("24.7", kShifted)));
  EXPECT_FALSE(is_unstable(lorenz("0.5", kShifted)));
  EXPECT_TRUE(is_unstable(lorenz("28.0", "[initial]\nstate = {x = 0.0, y = 0.0, z = 0.0}\n")));
  EXPECT_FALSE(is_unstable(lorenz("28.0", "[initial]\nstate = {x = 0.0, y = 1e-9, z = 0.0}\n")));
  EXPECT_FALSE(is_unstable(lorenz("28.0", "")));
}

TEST(UnstableStarts, NoModelHasOneAtItsDefaults) {
  for (const Model& model : models()) {
    const std::string parameter = model.parameters.front().name;
    EXPECT_FALSE(is_unstable("[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" +
                             model.states.front().name + "'\nvalues = [1.0]\n"))
        << model.name;
    Study study = read_study("[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" +
                                 parameter + "'\nvalues = [" +
                                 std::to_string(model.parameters.front().default_value) + "]\n",
                             "test.toml");
    const Plan plan(study, 16);
    EXPECT_FALSE(plan.is_autonomous() && starts_unstable(plan, 0, plan.own_initial_state(0)))
        << model.name;
  }
}

// x'' = x/T^2 - x^3/(L T)^2 - x'/T, which rests at 0, at -L and at L.
std::string two_wells(double length, double time, const std::string& forcing,
                      const std::string& start) {
  const auto text = [](double number) { return fmt::format("{}", number); };
  return "[model]\ntext = \"\"\"\n[model]\nname = 'wells'\n[states]\nx = {}\nv = {}\n[parameters]\n"
         "L = 1.0\nT = { value = 1.0, min = 1e-12 }\nF = 0.0\n[equations]\nx = 'v'\n"
         "v = 'x/T^2 - x^3/(L*T)^2 - 0.1*v/T + F*cos(phase)'\n[forcing]\nperiod = '2*pi*T'\n"
         "\"\"\"\n[parameters]\nL = " +
         text(length) + "\nF = " + forcing + "\n[[axes]]\nname = 'T'\nvalues = [" + text(time) +
         "]\n[initial]\nstate = {" + start + "}\n";
}

TEST(UnstableStarts, DoNotDependOnUnits) {
  for (const double length : {1e-9, 1.0, 1e5}) {
    for (const double time : {1e-6, 1.0, 100.0}) {
      const std::string at_well = fmt::format("x = {}", length);
      const std::string beside = fmt::format("x = {}", 1e-9 * length);
      EXPECT_TRUE(is_unstable(two_wells(length, time, "0.0", "")));
      EXPECT_FALSE(is_unstable(two_wells(length, time, "0.0", at_well)));
      EXPECT_FALSE(is_unstable(two_wells(length, time, "0.0", beside)));
      EXPECT_FALSE(is_unstable(two_wells(length, time, "1e-12", "")));
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
