// Models whose equations jump with a state, or bend: what is found in them, and what a study of
// them may ask.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "study/model_file.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// v' = -x + the expression.
std::string model_with(const std::string& expression, const std::string& options = "") {
  return fmt::format(
      "[model]\nname = \"dry\"\n[states]\nx = {{}}\nv = {{}}\n[parameters]\nb = 1.0\nk = 2.0\n"
      "omega = 1.0\n{}[equations]\nx = \"v\"\nv = \"-x + cos(phase) + 0*b*k + {}\"\n[forcing]\n"
      "period = \"2*pi/omega\"\n",
      options, expression);
}

std::string study_of(const std::string& model, const std::string& rest) {
  return "[model]\ntext = '''\n" + model + "'''\n[[axes]]\nname = 'omega'\nvalues = [0.7, 0.8]\n" +
         rest;
}

// Those that steps are cut at, then the others.
std::vector<std::string> jumps_of(const std::string& expression) {
  const auto model = read_model_text(model_with(expression), "dry.toml");
  std::vector<std::string> out;
  for (const SurfaceInfo& surface : model->surfaces) out.push_back(surface.expression);
  for (const StateJump& jump : model->state_jumps(model->default_setting())) {
    out.push_back(jump.expression);
  }
  return out;
}

TEST(RoughModel, HasTheJumpsOfItsEquations) {
  for (const auto& [text, found] : std::vector<std::pair<std::string, std::string>>{
           {"0.3*sign(v)", "sign(v)"},
           {"step(x)", "the condition x < 0"},
           {"floor(2*x)", "floor(2*x)"},
           {"x - floor(x)", "floor(x)"},
           {"if(x > b, k*(x - b) + 0.1*v, 0)", "the condition b < x"},
           {"if(v < b, k, k + 1)", "the condition v < b"},
           {"if(x > 0 and v > b, x, 0)", "the condition b < v"},
           {"if(x > b, 1, min(x, 1))", "the condition b < x"},
           {"if(x > b, -abs(v), v)", "the condition b < x"},
           {"sin(sign(v))", "sign(v)"},
           {"abs(v - sign(x))", "sign(x)"},
           {"x*sign(v)", "sign(v)"},
           {"atan2(v, x)", "atan2(v, x)"},
           {"sin(x*floor(v))", "floor(v)"},
           {"if(v == 0, 0, v/abs(v))", "abs(v)"},
           {"if(x > 0, sin(x)/x, 0)", "the condition 0 < x"},
           {"v/sqrt(v^2)", "sqrt(v*v)"}}) {
    EXPECT_THAT(jumps_of(text), ElementsAre(found)) << text;
  }
}

TEST(RoughModel, HasNoneWhereBothSidesAreTheSame) {
  for (const char* const text : {"x*sign(x)",
                                 "0.3*abs(0.25*x)",
                                 "0.3*max(-0.25*x, 0.1)",
                                 "0.3*min(k*x, b)",
                                 "7*if(x/4 > 0.1, x - 0.4, 0)",
                                 "v^2*sign(v)",
                                 "k*(x - b)*sign(x - b)",
                                 "if(x > b, k*(x - b), 0)",
                                 "if(x < b, k*b, k*x)",
                                 "if(x > 0, 3*x, 2*x)",
                                 "if(x > 0.3, 0.1*x, 0.03)",
                                 "if(x == 0, 1, sin(x)/x)",
                                 "abs(x)",
                                 "min(x, v)",
                                 "max(abs(x), k*v)",
                                 "clamp(x, -b, b)",
                                 "if(x > 1, 1, if(x < -1, -1, x))",
                                 "if(abs(x) < b, b - abs(x), 0)",
                                 "sin(3*atan2(v, x))",
                                 "cos(2*pi*floor(x))",
                                 "backlash(x, b)",
                                 "stop(x*v, cos(phase))",
                                 "if(b > 1, x, k*x)",
                                 "sin(x)/x + abs(x)",
                                 "sqrt(v^2)"}) {
    EXPECT_THAT(jumps_of(text), IsEmpty()) << text;
  }
}

// Each part of a signal is looked at once: 2^40 of these sums are met on the ways to their jump.
TEST(RoughModel, ReadsSignalsOfSharedParts) {
  std::string constants = "c0 = \"if(v > 0, 1, 0)\"\n";
  for (int i = 1; i <= 40; ++i) {
    constants += fmt::format("c{0} = \"c{1} - x*c{1}\"\n", i, i - 1);
  }
  const auto model = read_model_text(
      model_with("sign(v)", "[constants]\n" + constants) + "[signals]\ns = \"c40\"\n", "dry.toml");
  EXPECT_EQ(model->surfaces.size(), 1U);
}

// Steps are cut where it can be said on which side a motion is: not at the turn of atan2, and not
// where the place of a jump jumps itself.
TEST(RoughModel, KnowsTheSidesOfItsJumps) {
  const auto unlocated = [](const std::string& text) {
    const auto model = read_model_text(model_with(text), "dry.toml");
    return model->state_jumps(model->default_setting()).size();
  };
  EXPECT_EQ(unlocated("sign(v) + floor(x) + step(x - v)"), 0U);
  EXPECT_EQ(unlocated("atan2(v, x)"), 1U);
  EXPECT_EQ(unlocated("sign(v - sign(x))"), 1U);
}

// Which corners steps are corrected for.
TEST(RoughModel, HasTheCornersOfItsEquations) {
  struct Case {
    const char* text;
    std::size_t corners, uncorrected;
  };
  for (const Case& one : {Case{"abs(x)", 1, 0},
                          Case{"abs(x) + max(x, 0) + if(x < 0, x, k*x)", 1, 0},
                          Case{"clamp(x, -b, b)", 2, 0},
                          Case{"0.3*abs(0.25*x - 0.158)", 1, 0},
                          Case{"0.3*clamp(0.25*x, -0.5, 0.5)", 2, 0},
                          Case{"max(abs(x), abs(v))", 3, 0},
                          Case{"if(x > b, k*(x - b)*v, 0)", 1, 0},
                          Case{"if(x > b, k*x - k*b, 0)", 1, 0},
                          Case{"v*abs(v)", 1, 0},
                          Case{"x*sign(x)", 1, 0},
                          Case{"sin(min(x, b))", 1, 0},
                          Case{"if(x > 1, x^3 - 1, 0)", 1, 0},
                          Case{"if(x > 0, sin(x), 0)", 1, 0},
                          Case{"if(x > 1, 1, if(x < -1, -1, x))", 2, 0},
                          Case{"if(abs(x) < b, b - abs(x), 0)", 2, 0},
                          Case{"sqrt(x^2)", 1, 0},
                          Case{"sqrt(abs(x))", 0, 1},
                          Case{"abs(x)^1.5", 0, 1},
                          Case{"log(abs(x))", 0, 1},
                          Case{"if(x > 0, x*sqrt(x), 0)", 0, 1},
                          Case{"sqrt(1 + abs(x))", 1, 0},
                          Case{"sign(x)", 0, 0},
                          Case{"if(x > 0 and v > 0, x*v, 0)", 2, 0},
                          Case{"abs(cos(phase))*x", 0, 0},
                          Case{"if(x == 0, 1, sin(x)/x)", 0, 0}}) {
    const auto model = read_model_text(model_with(one.text), "dry.toml");
    EXPECT_EQ(model->corners, one.corners) << one.text;
    EXPECT_EQ(model->uncorrected.size(), one.uncorrected) << one.text;
  }
}

// They have no names, signals and quantities.
TEST(RoughModel, ShowsItsContactsAlone) {
  const auto model = read_model_text(model_with("backlash(x, b) + abs(v)"), "dry.toml");
  EXPECT_EQ(model->corners, 1U);
  ASSERT_EQ(model->contacts.size(), 1U);
  EXPECT_EQ(model->contacts[0].name, "");
  EXPECT_EQ(model->signals.size(), 2U);
  EXPECT_EQ(model->contact_limits().size(), 3U);
}

TEST(RoughModel, SaysWhatCannotBeAskedWhereStepsAreNotCut) {
  const std::string model = model_with("-0.3*atan2(v, x)");
  for (const char* const quantity :
       {"lyapunov_max", "lyapunov_max_error", "lyapunov_spectrum", "kaplan_yorke", "period",
        "motion_class", "settled", "attractor"}) {
    EXPECT_THAT(refusal(study_of(
                    model, fmt::format("[observe]\nquantities = ['x_rms', '{}']\n", quantity))),
                AllOf(HasSubstr("s.toml:"), HasSubstr(quantity),
                      HasSubstr("atan2(v, x) jumps with a state"), HasSubstr("the equation of v")))
        << quantity;
  }
  EXPECT_THAT(refusal(study_of(model, "[integrate]\ntolerance = 1e-4\n")), HasSubstr("max_step"));
  const Study study = read_study(
      study_of(model, "[observe]\nquantities = ['x_rms', 'x_max', 'poincare', 'zero_one']\n"),
      "s.toml");
  EXPECT_THAT(study.accuracy, HasSubstr("first order where atan2(v, x) jumps"));
  EXPECT_THAT(study.notices, ElementsAre(HasSubstr("atan2(v, x)")));
  EXPECT_EQ(study.integrate.stop, Stop::never);
  EXPECT_EQ(study.integrate.tolerance, 0.0);
}

// A choice that the study makes takes a jump away.
TEST(RoughModel, JumpsByItsOptions) {
  const std::string model = model_with(
      "-0.3*if(law.dry, atan2(v, x), tanh(9*v))",
      "[options]\nlaw = { choices = [\"dry\", \"smooth\"], meaning = \"of friction\" }\n");
  const std::string asked = "[observe]\nquantities = ['lyapunov_max']\n";
  EXPECT_THAT(refusal(study_of(model, asked)), HasSubstr("atan2(v, x)"));
  EXPECT_EQ(refusal(study_of(model, asked), {"model.law=smooth"}), "");
}

TEST(RoughModel, SaysThatACornerIsNotCorrected) {
  const Study study = read_study(study_of(model_with("sqrt(abs(x))"), ""), "s.toml");
  EXPECT_THAT(study.accuracy, HasSubstr("second order"));
}

}  // namespace
}  // namespace gearsweep::testing
