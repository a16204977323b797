// The table of initial policies, and where presets start.
#include "study/initial_policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;

TEST(InitialPolicies, EachStandsInItsRow) {
  for (std::size_t i = 0; i < initial_policies().size(); ++i) {
    EXPECT_EQ(initial_policies()[i].policy, static_cast<InitialPolicy>(i));
  }
  EXPECT_EQ(info_of(InitialPolicy::backward).name, "backward");
}

TEST(InitialPolicies, AreWithOrWithoutANeighbour) {
  EXPECT_THAT(policy_names(), ElementsAre("fixed", "shifted", "forward", "backward"));
  EXPECT_THAT(policy_names(false), ElementsAre("fixed", "shifted"));
  EXPECT_THAT(policy_names(true), ElementsAre("forward", "backward"));
}

Study study_of(const Model& model, const std::string& preset, const std::string& rest = "") {
  return read_study("[model]\nname = '" + model.name + "'\n" + preset + "[[axes]]\nname = '" +
                        model.states.front().name + "'\nvalues = [1.0]\n" + rest,
                    "test.toml");
}

TEST(InitialPolicies, TheFirstPresetHoldsWhereNoneIsNamed) {
  for (const Model& model : models()) {
    const Study unnamed = study_of(model, "");
    const Study named = study_of(model, "preset = '" + model.presets.front().name + "'\n");
    EXPECT_EQ(unnamed.preset, named.preset) << model.name;
    EXPECT_EQ(unnamed.setting.parameters, named.setting.parameters) << model.name;
    EXPECT_EQ(unnamed.setting.options, named.setting.options) << model.name;
    EXPECT_EQ(unnamed.initial.policy, named.initial.policy) << model.name;
    EXPECT_EQ(unnamed.initial.state, named.initial.state) << model.name;
  }
}

// As their meaning says.
TEST(InitialPolicies, ClassicPresetsStartAsPublished) {
  const auto start = [](const char* name) { return study_of(*find_model(name), "").initial.state; };
  EXPECT_THAT(start("lorenz"), ElementsAre(0.0, -0.01, 9.0));
  EXPECT_THAT(start("rossler"), ElementsAre(-9.0, 0.0, 0.0));
  EXPECT_THAT(start("chua"), ElementsAre(0.0, 0.0, 0.6));
  EXPECT_THAT(start("jerk"), ElementsAre(0.0, -0.7, 0.0));
}

TEST(InitialPolicies, AStudyMovesTheStartOfAPreset) {
  const Model& lorenz = *find_model("lorenz");
  EXPECT_THAT(study_of(lorenz, "", "[initial]\nstate = {z = 1.0}\n").initial.state,
              ElementsAre(0.0, -0.01, 1.0));
  EXPECT_EQ(study_of(lorenz, "", "[initial]\npolicy = 'shifted'\n").initial.policy,
            InitialPolicy::shifted);
  const Model& gear1 = *find_model("gear1");
  EXPECT_EQ(study_of(gear1, "").initial.policy, InitialPolicy::shifted);
  EXPECT_EQ(study_of(gear1, "", "[initial]\nstate = {v = 1.0}\n").initial.policy,
            InitialPolicy::fixed);
}

TEST(InitialPolicies, APresetOfAFileHasAStart) {
  const std::string model =
      "[model]\nname = 'own'\n[states]\nx = {}\nv = {}\n[equations]\nx = 'v'\n"
      "v = '-x'\n[forcing]\nperiod = 'a'\n[parameters]\na = 1.0\n[presets.far]\n";
  const auto initial = [&](const std::string& preset) {
    return read_study("[model]\ntext = \"\"\"\n" + model + preset +
                          "\n\"\"\"\n[[axes]]\nname = 'x'\nvalues = [1.0]\n",
                      "test.toml")
        .initial;
  };
  EXPECT_EQ(initial("state = { v = 3.0 }").policy, InitialPolicy::fixed);
  EXPECT_THAT(initial("state = { v = 3.0 }").state, ElementsAre(0.0, 3.0));
  EXPECT_THROW(initial("state = { w = 3.0 }"), InputError);
  EXPECT_THROW(initial("policy = 'shifted'\nstate = { v = 3.0 }"), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
