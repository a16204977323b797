// Which states a study need not integrate.
#include "plan/passive_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "study/builtin_models.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

const std::string kForce = "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.0\ncount = 9\n";

std::vector<std::string> kept(const std::string& toml,
                              const std::vector<std::string>& overrides = {
                                  "observe.quantities=['dmf_max', 'contact_class']"}) {
  const Study study = without_passive_states(read_study(toml, "test.toml", overrides));
  std::vector<std::string> names;
  for (const ChannelInfo& state : study.model->states) names.push_back(state.name);
  return names;
}

std::vector<std::string> all_of_gear5() {
  std::vector<std::string> names;
  for (const ChannelInfo& state : gear5().states) names.push_back(state.name);
  return names;
}

TEST(PassiveStates, ShaftsAcrossTheLineOfActionDriveNothingWhileTheBacklashIsConstant) {
  EXPECT_THAT(kept(kForce + "[parameters]\nk2 = 1.5\n"),
              ElementsAre("x1", "x3", "x5", "v1", "v3", "v5"));
}

TEST(PassiveStates, OneOfTwoShaftsThatAreAlikeDoes) {
  EXPECT_THAT(kept(kForce), ElementsAre("x1", "x3", "v1", "v3"));
}

TEST(PassiveStates, ABacklashThatFollowsTheShaftsNeedsBothDirections) {
  EXPECT_THAT(kept("[model]\nbacklash = 'dynamic'\n" + kForce),
              ElementsAre("x1", "x2", "x3", "v1", "v2", "v3"));
  EXPECT_EQ(kept("[model]\nbacklash = 'dynamic'\n[parameters]\nk1 = 1.2\nk2 = 1.5\n" + kForce),
            all_of_gear5());
}

TEST(PassiveStates, WhatIsLookedAtStays) {
  const std::string observe = "[observe]\nquantities = ";
  EXPECT_THAT(kept(kForce + observe + "['x2_rms']", {}),
              ElementsAre("x1", "x2", "x3", "v1", "v2", "v3"));
  EXPECT_THAT(kept(kForce + observe + "['x5_rms']", {}),
              ElementsAre("x1", "x3", "x5", "v1", "v3", "v5"));
  EXPECT_THAT(kept(kForce + observe + "['poincare']\npoincare = ['x1', 'v4']", {}),
              ElementsAre("x1", "x3", "x4", "v1", "v3", "v4"));
  for (const char* all : {"lyapunov_spectrum", "kaplan_yorke", "attractor"}) {
    EXPECT_EQ(kept(kForce + observe + "['" + all + "']", {}), all_of_gear5()) << all;
  }
}

TEST(PassiveStates, AllStayWhereTheStudySaysSo) {
  EXPECT_EQ(kept(kForce + "[integrate]\nstates = 'all'\n"), all_of_gear5());
  EXPECT_EQ(kept(kForce + "[integrate]\nengine = 'reference'\n"), all_of_gear5());
}

TEST(PassiveStates, ShaftsThatSomePointTellsApartDoNotMirrorEachOther) {
  const std::vector<std::string> both = {"x1", "x3", "x5", "v1", "v3", "v5"};
  EXPECT_EQ(kept("[[axes]]\nname = 'k4'\nfrom = 1.0\nto = 1.38\ncount = 3\n"), both);
  EXPECT_EQ(kept("[[axes]]\nname = 'x3'\nfrom = -1.0\nto = 1.0\ncount = 3\n"), both);
  EXPECT_EQ(kept(kForce + "[initial]\nensemble = 4\n"), both);
  EXPECT_EQ(kept(kForce + "[initial]\npolicy = 'fixed'\nstate = {x3 = 0.1}\n"), both);
  EXPECT_THAT(kept(kForce + "[initial]\npolicy = 'fixed'\nstate = {x3 = 0.1, x5 = -0.1}\n"),
              ElementsAre("x1", "x3", "v1", "v3"));
}

TEST(PassiveStates, WhatDoesNotDecayIsIntegrated) {
  EXPECT_EQ(kept(kForce + "[parameters]\nc1 = 0.0\n"), all_of_gear5());
  EXPECT_EQ(kept("[[axes]]\nname = 'c3'\nvalues = [0.0, 0.5, 1.0, 1.5, 2.0]\n"), all_of_gear5());
}

// A shaft that is rigid and a ring that is fixed have states that drive nothing.
TEST(PassiveStates, OtherModelsNeedAllTheirStates) {
  const std::set<std::string> idle = {"two_stages", "planetary"};
  for (const Model& model : models()) {
    if (model.name == "gear5") continue;
    const Study study = read_study("[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" +
                                       model.parameters[0].name + "'\nvalues = [" +
                                       std::to_string(model.parameters[0].default_value) + "]\n",
                                   "test.toml");
    const bool needs_all = without_passive_states(study).model == study.model;
    EXPECT_NE(needs_all, idle.contains(model.name)) << model.name;
  }
}

TEST(PassiveStates, PointsStartWithTheStatesThatAreKept) {
  const Study study = without_passive_states(read_study(kForce, "test.toml"));
  ASSERT_NE(study.model->whole, nullptr);
  const std::vector<double> rest = gear5().equilibrium(study.setting);
  EXPECT_THAT(study.model->own_state(rest), ElementsAre(rest[0], rest[2], rest[5], rest[7]));
}

// x'' + 2 m c zeta x' + m k x = 0, of the shafts across the line of action, and of the sum of the
// two that mirror each other.
TEST(PassiveStates, TheirExponentsAreThoseOfADampedOscillator) {
  const Study study = without_passive_states(read_study(
      kForce + "[parameters]\nc1 = 0.5\nc3 = 0.7\nk1 = 2.0\nzeta = 0.08\n", "test.toml"));
  ASSERT_EQ(study.model->states.size(), 4U);
  const double m = parameter_of(study.setting, "m1");
  const std::vector<double> exponents = left_out_exponents(*study.model, study.setting);
  ASSERT_EQ(exponents.size(), 6U);
  const std::vector<double> damping = {0.5, 0.5, 0.7, 0.7, 2.0, 2.0};
  for (std::size_t i = 0; i < damping.size(); ++i) {
    EXPECT_NEAR(exponents[i], -m * damping[i] * 0.08, 1e-12);
  }
}

// A model of three states, x'' driven by a third one.
std::string with_third(const std::string& x_force, const std::string& u_rate,
                       const std::string& parameters = "") {
  return "[model]\ntext = \"\"\"\n[model]\nname = 'third'\n[states]\nx = { start = '1e-9' }\nv = "
         "{}\n"
         "u = {}\n[parameters]\ng = 0.2\nomega = { value = 1.0, min = 1e-3 }\n" +
         parameters + "[equations]\nx = 'v'\nv = '" + x_force + "'\nu = '" + u_rate +
         "'\n[forcing]\nperiod = '2*pi/omega'\n\"\"\"\n";
}
const std::string kThirdAxis = "[[axes]]\nname = 'omega'\nvalues = [0.9, 1.1]\n";

std::vector<std::string> kept_of_third(const std::string& x_force, const std::string& u_rate,
                                       const std::string& rest = kThirdAxis,
                                       const std::string& parameters = "") {
  return kept(with_third(x_force, u_rate, parameters) + rest, {"observe.quantities=['x_rms']"});
}

const std::vector<std::string> kAllThree = {"x", "v", "u"};
const std::vector<std::string> kFirstTwo = {"x", "v"};

// Beside the other terms these are lost in rounding, or begin far out: no state that anybody would
// try shows them.
TEST(PassiveStates, WhatDrivesFaintlyOrFarOutIsKept) {
  const std::string u = "-u + 10*cos(phase)";
  EXPECT_EQ(kept_of_third("-0.3*v + x - 1e18*x^3 + 1e-9*g*cos(phase) + 1e-10*u", u), kAllThree);
  EXPECT_EQ(kept_of_third("-x - 0.1*v + g*cos(phase) + 0.01*max(u - 5000, 0)", u), kAllThree);
  EXPECT_EQ(kept_of_third("-x - g*v + (1e20*u + u - 1e20*u)", u), kAllThree);
  EXPECT_EQ(kept_of_third("-x - 0.1*v + if(x > 1e9, u, g)", u), kAllThree);
  EXPECT_EQ(kept_of_third("-x - 0.1*v + g*cos(phase)", u), kFirstTwo);
}

TEST(PassiveStates, ACoefficientOfZeroDrivesNothingUnlessItsFactorMayBeInfinite) {
  const std::string u = "-u + 10*cos(phase)", none = "[parameters]\ng = 0.0\n" + kThirdAxis;
  EXPECT_EQ(kept_of_third("-x - 0.1*v + g*sin(u) + cos(phase)", u, none), kFirstTwo);
  EXPECT_EQ(kept_of_third("-x - 0.1*v + g*log(u) + cos(phase)", u, none), kAllThree);
  EXPECT_EQ(kept_of_third("-x - 0.1*v + g*u + cos(phase)", u,
                          "[[axes]]\nname = 'g'\nvalues = [0.0, 0.1]\n"),
            kAllThree);
  EXPECT_EQ(
      kept_of_third("-x - 0.1*v + g*u + cos(phase)", u, "[[axes]]\nname = 'g'\nvalues = [0.0]\n"),
      kFirstTwo);
}

// Their slope is the same everywhere, or nearly so, and yet they are not linear.
TEST(PassiveStates, WhatIsNotLinearIsIntegrated) {
  const std::string x = "-x - 0.1*v + g*cos(phase)";
  EXPECT_EQ(kept_of_third(x, "-u + floor(u)"), kAllThree);
  EXPECT_EQ(kept_of_third(x, "if(u > 0, 1 - u, -1 - u)"), kAllThree);
  EXPECT_EQ(kept_of_third(x, "-u + 1e-9*max(u - 1e6, 0)"), kAllThree);
  EXPECT_EQ(kept_of_third(x, "-(1 + 1e-15*sin(phase))*u"), kAllThree);
  EXPECT_EQ(kept_of_third(x, "-(1 + g*x)*u"), kAllThree);
  EXPECT_EQ(kept_of_third(x, "if(x > 0, 1 - u, -1 - u)"), kFirstTwo);
  EXPECT_EQ(kept_of_third(x, "x*v - u*(1 + g)"), kFirstTwo);
}

// It decays at all of the many points, or it is integrated.
TEST(PassiveStates, EveryPointOfAParameterIsLookedAt) {
  const std::string x = "-x - 0.1*v + cos(phase)", u = "-(g - 0.37)^2*u + (g - 0.371)*u*1e-9";
  EXPECT_EQ(kept_of_third(x, u, "[[axes]]\nname = 'g'\nfrom = 0.0\nto = 1.0\ncount = 11\n"),
            kFirstTwo);
  EXPECT_EQ(kept_of_third(x, "(0.5 - 1e6*(g - 0.37)^2)*u",
                          "[[axes]]\nname = 'g'\nfrom = 0.0\nto = 1.0\ncount = 101\n"),
            kAllThree);
}

TEST(PassiveStates, GearsNeedWhatTheirOptionsAndParametersSay) {
  const std::vector<std::string> x2 = {"observe.quantities=['x2_rms']"};
  EXPECT_THAT(kept("[parameters]\nmu = 0.0\n" + kForce, x2),
              ElementsAre("x1", "x2", "x3", "v1", "v2", "v3"));
  EXPECT_THAT(kept("[model]\nformulation = 'printed'\n" + kForce),
              ElementsAre("x1", "x3", "v1", "v3"));
  EXPECT_THAT(
      kept("[model]\nformulation = 'printed'\nbacklash = 'dynamic'\n[parameters]\nk2 = 1.5\n" +
           kForce),
      ElementsAre("x1", "x2", "x3", "x5", "v1", "v2", "v3", "v5"));
  EXPECT_THAT(kept("[[axes]]\nname = 'zeta'\nfrom = 0.01\nto = 0.1\ncount = 7\n"),
              ElementsAre("x1", "x3", "v1", "v3"));
  EXPECT_THAT(kept(kForce, {"observe.quantities=['bearing_p_max']"}),
              ElementsAre("x1", "x2", "x3", "v1", "v2", "v3"));
}

// Who enters whose equation is known from how these were written.
TEST(PassiveStates, AStateThatDrivesNothingIsLeftOutOfRandomModels) {
  std::mt19937 random(11);
  const auto below = [&](std::size_t count) { return random() % count; };
  const std::vector<std::string> forms = {
      "0.3*S",        "1e-12*S",         "sin(S)", "max(S - 1e5, 0)", "x0*S", "backlash(S, 9)",
      "stop(S, 100)", "if(S > 3, 1, 0)", "S^3",    "exp(-S^2)"};
  int count_left_out = 0;
  for (int model = 0; model < 60; ++model) {
    const std::size_t states = 2 + below(4);
    std::vector<std::set<std::size_t>> drivers(states);
    std::string text = "[model]\ntext = \"\"\"\n[model]\nname = 'random'\n[states]\n";
    std::string equations = "[equations]\n";
    for (std::size_t i = 0; i < states; ++i) {
      text += "x" + std::to_string(i) + " = {}\n";
      // Not linear, so that it stays if it drives something and if it does not.
      std::string rate = "cos(phase) - x" + std::to_string(i) + "^3";
      for (std::size_t terms = below(3); terms > 0; --terms) {
        const std::size_t by = below(states);
        std::string form = forms[below(forms.size())];
        if (form == "x0*S") drivers[i].insert(0);
        for (std::size_t at; (at = form.find('S')) != std::string::npos;) {
          form.replace(at, 1, "x" + std::to_string(by));
        }
        rate += " + " + form;
        drivers[i].insert(by);
      }
      equations += "x" + std::to_string(i) + " = '" + rate + "'\n";
    }
    text += "idle = {}\n[parameters]\nomega = { value = 1.0, min = 1e-3 }\n" + equations +
            "idle = 'x0^2*cos(phase) - 0.7*idle'\n[forcing]\nperiod = '2*pi/omega'\n\"\"\"\n" +
            kThirdAxis;
    // The section follows the first state.
    const std::string last = "x" + std::to_string(states - 1);
    std::set<std::size_t> needed = {0, states - 1};
    for (bool grows = true; grows;) {
      grows = false;
      for (const std::size_t state : std::set<std::size_t>(needed)) {
        for (const std::size_t by : drivers[state]) grows |= needed.insert(by).second;
      }
    }
    const auto names = kept(text, {"observe.quantities=['" + last + "_rms']"});
    for (const std::size_t state : needed) {
      EXPECT_THAT(names, Contains("x" + std::to_string(state))) << text;
    }
    // Others that drive nothing are not linear, and so they all are integrated.
    const bool is_only_one = needed.size() == states;
    EXPECT_EQ(names.size(), is_only_one ? states : states + 1) << text;
    count_left_out += is_only_one ? 1 : 0;
  }
  EXPECT_GE(count_left_out, 15);
}

TEST(MirrorPairs, StatesThatMirrorEachOtherKeepThatAtAnyAlikeParameters) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    ModelSetting setting = gear5().default_setting();
    for (double& value : setting.parameters) value *= 0.5 + unit(random);
    for (std::size_t option = 0; option < setting.options.size(); ++option) {
      setting.options[option] = static_cast<int>(random() % gear5().options[option].choices.size());
    }
    std::vector<double> x(gear5().states.size()), dx(x.size());
    for (double& value : x) value = 4.0 * unit(random) - 2.0;
    for (const MirrorPairs& pairs : gear5().mirror_pairs) {
      for (const auto& [first, second] : pairs.parameters) {
        setting.parameters[second] = setting.parameters[first];
      }
      for (const auto& [first, second] : pairs.states) x[second] = -x[first];
    }
    std::vector<double> coefs(gear5().phase_coefs.size());
    const double phase = unit(random);
    gear5().phase_coefs_at(setting, phase, phase, coefs.data());
    gear5().prepare(setting)->rhs(coefs.data(), x.data(), dx.data());
    const std::vector<double> rest = gear5().equilibrium(setting);
    for (const MirrorPairs& pairs : gear5().mirror_pairs) {
      for (const auto& [first, second] : pairs.states) {
        EXPECT_EQ(dx[second], -dx[first]);
        EXPECT_EQ(rest[second], -rest[first]);
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
