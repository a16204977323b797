// A study reads as it is written: presets, then dimensions, then parameters, then overrides.
#include "study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/builtin_models.hpp"
#include "study/refusal.hpp"
#include "study/settings.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::refusal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kAxis = "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n";

double parameter(const Study& study, const std::string& name) {
  return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
}

std::string origin(const Study& study, const std::string& name) {
  return study.parameter_origins[static_cast<std::size_t>(study.model->find_parameter(name))];
}

int option(const Study& study, const std::string& name) {
  return study.setting.options[static_cast<std::size_t>(study.model->find_option(name))];
}

TEST(Study, AWordOnTheCommandLineNeedsNoQuotesOfItsOwn) {
  for (const std::string title : {"it's", "the \"best\" map", "a\\b", "two words"}) {
    const Study study =
        read_study("[[axes]]\nname = 'omega'\nvalues = [1]\n", "s.toml", {"title=" + title});
    EXPECT_EQ(study.title, title);
  }
}

TEST(Study, AWholeNumberMayBeWrittenWithAPowerOfTen) {
  const std::string axis = "[[axes]]\nname = 'omega'\nfrom = 1\nto = 2\ncount = 5e0\n";
  const Study study = read_study(axis + "[integrate]\nsettle = 1e3\n", "s.toml");
  EXPECT_EQ(study.integrate.settle, 1000U);
  EXPECT_EQ(study.axes[0].values.size(), 5U);
  for (const char* wrong : {"1.5e0", "inf", "nan", "1e300", "true"}) {
    const std::string text = axis + "[integrate]\nsettle = " + wrong + "\n";
    EXPECT_THAT(refusal(text), HasSubstr("a whole number")) << wrong;
  }
}

TEST(Study, GivenParametersOverrideThePreset) {
  const Study study = read_study(
      std::string("[model]\npreset = 'paper'\n[parameters]\nmu = 0.1\n") + kAxis, "s.toml");
  EXPECT_EQ(parameter(study, "F1"), 0.173386);
  EXPECT_EQ(origin(study, "F1"), "preset paper");
  EXPECT_EQ(parameter(study, "mu"), 0.1);
  EXPECT_EQ(origin(study, "mu"), "s.toml:4");
  EXPECT_EQ(option(study, "formulation"), 1);
  EXPECT_EQ(study.initial.policy, InitialPolicy::fixed);
}

TEST(Study, GivenOptionsOverrideThePreset) {
  const Study study = read_study(
      std::string("[model]\npreset = 'paper'\nformulation = 'consistent'\n") + kAxis, "s.toml");
  EXPECT_EQ(option(study, "formulation"), 0);
  EXPECT_EQ(option(study, "stiffness"), 2);
}

TEST(Study, AListFillsTheNumberedParameters) {
  const Study study = read_study(
      std::string("[model]\nstiffness = 'fourier'\n[parameters]\nkappa = [0.1, 0.02]\n") + kAxis,
      "s.toml");
  EXPECT_EQ(parameter(study, "kappa"), 0.1);
  EXPECT_EQ(parameter(study, "kappa_2"), 0.02);
  EXPECT_THAT(refusal(std::string("[parameters]\nkappa = [0, 0, 0, 0, 0]\n") + kAxis),
              HasSubstr("at most 4 numbers"));
}

TEST(Study, OverridesReachEveryKey) {
  const Study study = read_study(std::string("[model]\npreset = 'coarse'\n") + kAxis, "s.toml",
                                 {"integrate.record=7", "model.backlash=dynamic", "parameters.mu=0",
                                  "axes.omega.values=[0.1, 0.2, 0.3]", "axes.0.scale=log"});
  EXPECT_EQ(study.integrate.record, 7U);
  EXPECT_EQ(option(study, "backlash"), 1);
  EXPECT_EQ(parameter(study, "mu"), 0.0);
  EXPECT_EQ(study.points(), 3U);
  EXPECT_TRUE(study.axes[0].logarithmic);
}

TEST(Study, ItsTomlGivesTheSameStudyWithoutTheOverrides) {
  const Study study = read_study(kAxis, "s.toml", {"integrate.record=7", "title=again"});
  const Study again = read_study(study.toml, "again.toml");
  EXPECT_EQ(again.toml, study.toml);
  EXPECT_EQ(again.integrate.record, 7U);
  EXPECT_EQ(again.title, "again");
  EXPECT_EQ(again.axes[0].values, study.axes[0].values);
}

TEST(Study, ItsSettingsNameEveryValueWithDefaultsResolved) {
  const Study study = read_study(std::string("[model]\npreset = 'paper'\n") + kAxis, "s.toml",
                                 {"integrate.events=false"});
  const Study again = read_study(resolved_settings(study) + kAxis, "settings");
  EXPECT_EQ(again.setting.parameters, study.setting.parameters);
  EXPECT_EQ(again.setting.options, study.setting.options);
  EXPECT_EQ(again.integrate.max_step, study.integrate.max_step);
  EXPECT_TRUE(read_study(kAxis, "s.toml").integrate.events);
  EXPECT_FALSE(again.integrate.events);
  EXPECT_EQ(again.integrate.settle, study.integrate.settle);
}

TEST(Study, AModelMayBringItsOwnStep) {
  const std::string lorenz = "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [28]\n";
  EXPECT_EQ(read_study(lorenz, "s.toml").integrate.max_step, find_model("lorenz")->max_step);
  EXPECT_LT(find_model("lorenz")->max_step, find_model("gear5")->max_step);
  EXPECT_THAT(resolved_settings(read_study(lorenz, "s.toml")), HasSubstr("max_step = 0.01\n"));
  EXPECT_EQ(read_study(lorenz, "s.toml", {"integrate.max_step=0.05"}).integrate.max_step, 0.05);
  EXPECT_EQ(
      read_study(lorenz, "s.toml", {"integrate.steps_per_period=64"}).integrate.steps_per_period,
      64U);
}

TEST(Study, ALogAxisHasAConstantRatio) {
  const Study study = read_study(
      "[[axes]]\nname = 'F1'\nfrom = 0.1\nto = 10.0\ncount = 3\nscale = 'log'\n", "s.toml");
  // pow and the product round once each.
  EXPECT_THAT(study.axes[0].values, ElementsAre(0.1, ::testing::DoubleNear(1.0, 1e-15), 10.0));
}

TEST(Study, ASingleValueIsAnAxis) {
  const Study study =
      read_study("[[axes]]\nname = 'b'\nfrom = 1.0\nto = 1.0\ncount = 1\n", "s.toml");
  EXPECT_THAT(study.axes[0].values, ElementsAre(1.0));
}

TEST(Study, ToleratesAsMuchOfExponentsAsOfOtherMapsUnlessToldOtherwise) {
  const auto integrate = [](const std::string& keys) {
    return read_study(std::string(kAxis) + "[integrate]\n" + keys, "s.toml").integrate;
  };
  EXPECT_EQ(integrate("").exponent_tolerance, 1e-3);
  EXPECT_EQ(integrate("tolerance = 1e-5\n").exponent_tolerance, 1e-5);
  const Integrate own = integrate("exponent_tolerance = 0.01\n");
  EXPECT_EQ(own.exponent_tolerance, 0.01);
  EXPECT_EQ(own.tolerance, 1e-3);
  EXPECT_TRUE(own.is_tolerance_asked);
  EXPECT_EQ(integrate("tolerance = 0\n").tolerance, 0.0);
}

TEST(Study, TolerancesThatCannotBeAreRefused) {
  const std::string text = std::string(kAxis) + "[integrate]\n";
  EXPECT_THAT(refusal(text + "tolerance = 1e-11\n"), HasSubstr("0, or from 1e-10 to 0.1"));
  EXPECT_THAT(refusal(text + "exponent_tolerance = 1e-11\n"), HasSubstr("from 1e-10 to 0.1"));
  EXPECT_THAT(refusal(text + "exponent_tolerance = 0.2\n"), HasSubstr("from 1e-10 to 0.1"));
  EXPECT_THAT(refusal(text + "exponent_tolerance = 0.01\nmax_step = 0.01\n"),
              HasSubstr("or the step, not both"));
}

TEST(Study, AnInitialStateIsAnAxis) {
  const Study study = read_study("[[axes]]\nname = 'v1'\nvalues = [-0.5, 0.5]\n", "s.toml");
  EXPECT_TRUE(study.axes[0].is_state);
  EXPECT_EQ(study.axes[0].index, 5U);
}

TEST(Study, SaysWhatIsTooLarge) {
  const std::string study = "[[axes]]\nname = 'x1'\nvalues = [0.0, 2e6]\n";
  EXPECT_THAT(refusal(study), HasSubstr("x1 = 2000000 is a start beyond 1000000"));
  EXPECT_EQ(read_study(study, "s.toml", {"integrate.diverged_above=1e7"}).model->diverged_above,
            std::vector<double>(10, 1e7));
  const Study some = read_study(study, "s.toml", {"integrate.diverged_above={x1 = 1e7}"});
  EXPECT_EQ(some.model->diverged_above[0], 1e7);
  EXPECT_EQ(some.model->diverged_above[1], 1e6);
}

TEST(Study, WithoutQuantitiesTheFirstStateIsObserved) {
  const Study study = read_study(kAxis, "s.toml");
  ASSERT_EQ(study.selection.quantities.size(), 1U);
  EXPECT_EQ(study.selection.quantities[0].name, "x1_rms");
  EXPECT_THAT(study.selection.poincare, ElementsAre(0U));
}

TEST(Study, QuantitiesOfOneChannelShareAnObserver) {
  const Study study = read_study(
      std::string(kAxis) + "[observe]\nquantities = ['x1_rms', 'x1_mean', 'dmf_max']\n", "s.toml");
  EXPECT_EQ(study.selection.observers.size(), 2U);
}

TEST(Study, ContradictionsInTheInitialPolicyAreRefused) {
  const std::string text(kAxis);
  EXPECT_THAT(refusal(text + "[initial]\npolicy = 'shifted'\nstate = {x1 = 1.0}\n"),
              HasSubstr("policy = \"fixed\""));
  EXPECT_THAT(refusal(text + "[initial]\nalong = 'omega'\n"), HasSubstr("forward"));
  EXPECT_THAT(refusal(text + "[initial]\npolicy = 'forward'\nalong = 'b'\n"),
              HasSubstr("unknown along 'b'"));
  EXPECT_THAT(refusal("[[axes]]\nname = 'x1'\nvalues = [0.0]\n[initial]\npolicy = 'forward'\n"),
              HasSubstr("initial state"));
  EXPECT_THAT(refusal(text + "[initial]\npolicy = 'fixed'\nstate = {x6 = 1.0}\n"),
              HasSubstr("unknown key 'x6'"));
}

TEST(Study, AnEnsembleHasASizeASeedAndASpread) {
  const std::string text = std::string(kAxis) + "[initial]\n";
  const Study all = read_study(text + "ensemble = 5\nseed = 9\nspread = 0.5\n", "s.toml");
  EXPECT_EQ(all.trajectories(), 10U);
  EXPECT_EQ(all.initial.seed, 9U);
  EXPECT_EQ(all.initial.spread, std::vector<double>(10, 0.5));
  const Study some = read_study(text + "ensemble = 5\nspread = {x1 = 2.0, v1 = 1}\n", "s.toml");
  EXPECT_THAT(some.initial.spread, ElementsAre(2, 0, 0, 0, 0, 1, 0, 0, 0, 0));
  EXPECT_EQ(read_study(kAxis, "s.toml").initial.ensemble, 1U);
}

TEST(Study, AnEnsembleThatMakesNoSenseIsRefused) {
  const std::string text = std::string(kAxis) + "[initial]\n";
  EXPECT_THAT(refusal(text + "seed = 3\n"), HasSubstr("s.toml:5: seed belongs to an ensemble"));
  EXPECT_THAT(refusal(text + "ensemble = 4\npolicy = 'forward'\n"),
              HasSubstr("policy = \"fixed\" or \"shifted\""));
  EXPECT_THAT(refusal(text + "ensemble = 4\nspread = {x9 = 1.0}\n"), HasSubstr("unknown key 'x9'"));
  EXPECT_THAT(refusal(text + "ensemble = 4\nspread = 'wide'\n"), HasSubstr("s.toml:6"));
  EXPECT_THAT(refusal(std::string(kAxis) + "[observe]\nquantities = ['attractor_count']\n"),
              HasSubstr("[initial] ensemble = 8"));
}

TEST(Study, TooMuchOutputIsRefused) {
  EXPECT_THAT(refusal("[[axes]]\nname = 'b'\nfrom = 0.1\nto = 1.0\ncount = 100000\n[integrate]\n"
                      "record = 100000\n[observe]\nquantities = ['poincare']\n"),
              HasSubstr("integrate.record"));
}

TEST(Study, AStudyNeedsOneOrTwoAxes) {
  EXPECT_THAT(refusal("title = 'x'\n"), HasSubstr("no axes"));
  EXPECT_THAT(refusal(std::string(kAxis) + "[[axes]]\nname = 'b'\nvalues = [1.0]\n[[axes]]\n"
                                           "name = 'mu'\nvalues = [0.1]\n"),
              HasSubstr("one or two"));
}

// Taking down tables that deep would overflow the stack.
TEST(Study, KeysOfTooManyPartsAreRefusedWithTheirLine) {
  std::string deep = "a";
  for (int part = 0; part < 1'000'000; ++part) deep += ".a";
  const auto too_deep = HasSubstr("a key of more than 64 parts");
  EXPECT_THAT(refusal("title = 'x'\n" + deep + " = 1\n"), HasSubstr("s.toml:2: a key of more"));
  EXPECT_THAT(refusal("[" + deep + "]\n"), too_deep);
  EXPECT_THAT(refusal("x = {\"]\"." + deep + " = 1}\n"), too_deep);
  EXPECT_THAT(refusal(kAxis, {deep + "=1"}), too_deep);
  EXPECT_THAT(refusal(kAxis, {"title={" + deep + "=1}"}), too_deep);
}

TEST(Study, DotsThatAreInNoKeyAreAllowed) {
  const std::string dots(200, '.');
  EXPECT_EQ(read_study("title = \"\\\"" + dots + "\" # " + dots + "\n" + kAxis, "s.toml").title,
            '"' + dots);
  EXPECT_EQ(read_study("title = '''\n'" + dots + "''" + dots + "'''\n" + kAxis, "s.toml").title,
            "'" + dots + "''" + dots);
}

}  // namespace
}  // namespace gearsweep
