// What parameters that expressions of others give come to at the points of a study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "plan/passive_states.hpp"
#include "plan/plan.hpp"
#include "plan/view_points.hpp"
#include "study/settings.hpp"
#include "support/derived_model.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::DoubleEq;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kWn = "[[axes]]\nname = 'wn'\nvalues = [1.0, 2.0, 4.0]\n";
const std::string kZeta = "[[axes]]\nname = 'zeta'\nvalues = [0.1, 0.2]\n";

Study derived_study(const std::string& keys, const std::vector<std::string>& overrides = {}) {
  return read_study(study_of_text(derived_model(), keys), "s.toml", overrides);
}

std::size_t index_of(const Study& study, const std::string& name) {
  return static_cast<std::size_t>(study.model->find_parameter(name));
}

// The values of a parameter at all trajectories of the study.
std::vector<double> values_of(const Study& study, const std::string& name) {
  const Plan plan(study, 100);
  std::vector<double> values;
  for (std::size_t i = 0; i < study.trajectories(); ++i) {
    values.push_back(plan.setting_of(i).parameters[index_of(study, name)]);
  }
  return values;
}

// In units of pi.
std::vector<double> periods_of(const Study& study) {
  const Plan plan(study, 100);
  std::vector<double> periods;
  for (std::size_t i = 0; i < study.trajectories(); ++i) {
    periods.push_back(study.model->period(plan.setting_of(i)) / std::numbers::pi);
  }
  return periods;
}

std::string refusal_of_plan(const Study& study) {
  try {
    const Plan plan(study, 100);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DerivedParameters, FollowOthersAtEachPoint) {
  const Study study = derived_study(kWn);
  EXPECT_THAT(values_of(study, "omega"), ElementsAre(0.5, 1.0, 2.0));
  EXPECT_THAT(periods_of(study), ElementsAre(4.0, 2.0, 1.0));
  EXPECT_TRUE(study.differs(index_of(study, "omega")));
  EXPECT_FALSE(study.differs(index_of(study, "e_2")));
  EXPECT_THAT(resolved_settings(study),
              AllOf(HasSubstr("omega = '0.5*wn'\n"), HasSubstr("e_2 = 0.15\n")));
}

TEST(DerivedParameters, AreGivenByStudiesAndOptions) {
  const Study study = derived_study("[parameters]\nzeta = 'wn/8 + g'\n" + kWn);
  EXPECT_THAT(values_of(study, "zeta"), ElementsAre(9.875, 10.0, 10.25));
  EXPECT_THAT(values_of(study, "omega"), ElementsAre(0.5, 1.0, 2.0));
  const Study set =
      derived_study(kWn, {"parameters.omega=2*wn", "parameters.e=['omega', 'e[1] + 1']"});
  EXPECT_THAT(values_of(set, "omega"), ElementsAre(2.0, 4.0, 8.0));
  EXPECT_THAT(values_of(set, "e"), ElementsAre(2.0, 4.0, 8.0));
  EXPECT_THAT(values_of(set, "e_2"), ElementsAre(3.0, 5.0, 9.0));
  // A result holds the same study; the text is what a journal knows it by.
  const Study again = read_study(set.toml, "again.toml");
  EXPECT_EQ(again.toml, set.toml);
  EXPECT_EQ(values_of(again, "e_2"), values_of(set, "e_2"));
  EXPECT_NE(set.toml, derived_study(kWn, {"parameters.omega=3*wn"}).toml);
}

TEST(DerivedParameters, GiveWayToNumbersAndAxes) {
  const Study given = derived_study("[parameters]\nomega = 4\n" + kWn);
  EXPECT_THAT(values_of(given, "omega"), Each(4.0));
  EXPECT_THAT(periods_of(given), Each(0.5));
  const Study swept = derived_study(kWn + "[[axes]]\nname = 'omega'\nvalues = [0.5, 4]\n",
                                    {"parameters.omega=2*wn"});
  EXPECT_THAT(values_of(swept, "omega"), ElementsAre(0.5, 0.5, 0.5, 4.0, 4.0, 4.0));
  EXPECT_THAT(periods_of(swept), ElementsAre(4.0, 4.0, 4.0, 0.5, 0.5, 0.5));
  const Study listed =
      derived_study("[points]\nnames = ['omega', 'zeta']\nnumbers = '''\n2 0.1\n4 0.2\n'''\n");
  EXPECT_THAT(periods_of(listed), ElementsAre(1.0, 0.5));
}

TEST(DerivedParameters, FollowWhatIsUncertain) {
  const Study study = derived_study(
      "[uncertain]\nsamples = 3\nwn = {distribution = 'uniform', from = 1, to = 3}\n");
  const std::vector<double> wn = values_of(study, "wn"), omega = values_of(study, "omega");
  const std::vector<double> periods = periods_of(study);
  ASSERT_EQ(omega.size(), 4U);
  EXPECT_EQ(omega[0], 1.0);
  EXPECT_NE(omega[1], omega[2]);
  for (std::size_t i = 0; i < omega.size(); ++i) {
    EXPECT_EQ(omega[i], 0.5 * wn[i]);
    EXPECT_THAT(periods[i], DoubleEq(4.0 / wn[i]));
  }
}

// Then they are numbers around what the expression comes to, relative or not.
TEST(DerivedParameters, AreUncertainThemselves) {
  for (const char* tolerance : {"{values = [4.0]}", "{values = [4.0], relative = true}"}) {
    const Study study =
        derived_study(kZeta + "[uncertain]\nsamples = 2\nomega = " + tolerance + "\n");
    EXPECT_THAT(values_of(study, "omega"), ElementsAre(1.0, 1.0, 4.0, 4.0, 4.0, 4.0));
    EXPECT_THAT(periods_of(study), ElementsAre(2.0, 2.0, 0.5, 0.5, 0.5, 0.5));
  }
}

// Points are refused by what the expression comes to there, with its place.
TEST(DerivedParameters, MustBeFiniteAndInRangeAtEachPoint) {
  EXPECT_THAT(refusal_of_plan(derived_study("[parameters]\nzeta = '1/(wn - 2)'\n" + kWn)),
              HasSubstr("s.toml:23: zeta = 1/(wn - 2) comes to inf, which is no finite number"));
  EXPECT_THAT(refusal_of_plan(derived_study(kWn, {"parameters.omega=3*wn"})),
              HasSubstr("--set parameters.omega=3*wn: omega = 3*wn comes to 12, out of range; from "
                        "0.01 to 10 is allowed"));
}

TEST(DerivedParameters, AreWorkedOutInViews) {
  const auto study = std::make_shared<const Study>(
      derived_study("[parameters]\nomega = 'wn*zeta'\n" + kWn + kZeta));
  const ViewPoints view(study, {1, {{{0, 2}, {1, 1}}}});
  ModelSetting setting = study->setting;
  view.set(1, &setting);
  EXPECT_EQ(setting.parameters[index_of(*study, "wn")], 2.5);
  EXPECT_EQ(setting.parameters[index_of(*study, "omega")],
            2.5 * setting.parameters[index_of(*study, "zeta")]);
}

// gear5's shafts mirror each other while their bearings are alike: at all points, not at the one
// that the study would have without its axis.
TEST(DerivedParameters, MayMakeAlikeWhatIsSo) {
  const std::string quiet =
      "[integrate]\nsettle = 1\nrecord = 1\n[observe]\nquantities = "
      "['x1_rms']\n";
  const auto states = [&](const std::string& keys) {
    return without_passive_states(
               read_study("[model]\npreset = 'coarse'\n" + keys + quiet, "s.toml"))
        .model->states.size();
  };
  const std::string mu = "[[axes]]\nname = 'mu'\nvalues = [0.01, 0.02]\n";
  EXPECT_LT(states(mu), 10U);
  EXPECT_EQ(states(mu), states("[parameters]\nm2 = 'm1'\nk4 = 'k2'\n" + mu));
  const std::string k4 = "[parameters]\nmu = 0.01\nk4 = 'k2*(1 + 10*(mu - 0.01))'\n";
  EXPECT_EQ(states(mu + k4), states(mu) + 2);
}

}  // namespace
}  // namespace gearsweep::testing
