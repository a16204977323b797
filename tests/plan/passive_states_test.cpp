// Which states a study need not integrate.
#include "plan/passive_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "study/builtin_models.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

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

TEST(PassiveStates, OtherModelsNeedAllTheirStates) {
  for (const Model& model : models()) {
    if (model.name == "gear5") continue;
    const Study study = read_study("[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" +
                                       model.parameters[0].name + "'\nvalues = [" +
                                       std::to_string(model.parameters[0].default_value) + "]\n",
                                   "test.toml");
    EXPECT_EQ(without_passive_states(study).model, study.model) << model.name;
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
    for (const MirrorPairs& pairs : gear5().mirror_pairs) {
      for (const auto& [first, second] : pairs.states) EXPECT_EQ(dx[second], -dx[first]);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
