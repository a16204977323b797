// Functions, sums and lists in a model's file: the same numbers as written out.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "study/model_file.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

const std::string kShort = R"~([model]
name = "many"
[states]
x = {}
v = {}
[parameters]
omega = 0.9
e = [0.3, -0.1, 0.05]
w = { value = [1.0, 2.0], min = 0.0, max = 10.0, unit = "N", meaning = "weight" }
[functions]
"hertz(p)" = "max(p, 0)^1.5"
"both(x, gap)" = "hertz(x - gap) - hertz(-x - gap)*(1 + 0.1*v)"
[constants]
c = ["0.5*omega", "c[1] + 1"]
[equations]
x = "v"
v = "sum(i, 1, 3, e[i]*cos(i*phase)) - both(2*x, 0.2)*sum(k, 0, 1, w[k + 1]) - c[2]*x - sum(i, 2, 1, x)"
[forcing]
period = "2*pi/omega"
)~";

const std::string kLong = R"~([model]
name = "many"
[states]
x = {}
v = {}
[parameters]
omega = 0.9
e = 0.3
e_2 = -0.1
e_3 = 0.05
w = 1.0
w_2 = 2.0
[equations]
x = "v"
v = "e*cos(phase) + e_2*cos(2*phase) + e_3*cos(3*phase) - (max(2*x - 0.2, 0)^1.5 - max(-2*x - 0.2, 0)^1.5*(1 + 0.1*v))*(w + w_2) - (0.5*omega + 1)*x"
[forcing]
period = "2*pi/omega"
)~";

std::vector<double> rates(const Model& model, double phase, const std::vector<double>& x) {
  const ModelSetting setting = model.default_setting();
  std::vector<double> coefs(model.phase_coefs.size()), out(x.size());
  model.phase_coefs_at(setting, phase, phase, coefs.data());
  model.prepare(setting)->rhs(coefs.data(), x.data(), out.data());
  return out;
}

TEST(ModelFunctions, AreWhatTheyStandFor) {
  const auto brief = read_model_text(kShort, "short.toml"),
             full = read_model_text(kLong, "long.toml");
  ASSERT_EQ(brief->parameters.size(), full->parameters.size());
  for (std::size_t i = 0; i < full->parameters.size(); ++i) {
    EXPECT_EQ(brief->parameters[i].name, full->parameters[i].name);
    EXPECT_EQ(brief->parameters[i].default_value, full->parameters[i].default_value);
  }
  EXPECT_EQ(brief->parameters.back().unit, "N");
  EXPECT_EQ(brief->parameters.back().max, 10.0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> state(-1.0, 1.0), phase(0.01, 0.99);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> x = {state(random), state(random)};
    const double psi = phase(random);
    const std::vector<double> one = rates(*brief, psi, x), other = rates(*full, psi, x);
    EXPECT_DOUBLE_EQ(one[0], other[0]);
    EXPECT_NEAR(one[1], other[1], 1e-13 * (1.0 + std::fabs(other[1])));
  }
}

struct Mistake {
  std::string from, to, message;
};

TEST(ModelFunctions, MistakesAreToldWithTheirPlace) {
  for (const Mistake& mistake : std::vector<Mistake>{
           {"both(2*x, 0.2)", "both(2*x)", "m.toml:17:40: both() takes 2 arguments, not 1"},
           {"both(2*x, 0.2)", "bothe(2*x)", "unknown function 'bothe'; did you mean 'both'?"},
           {"max(p, 0)^1.5", "max(q, 0)^1.5", "m.toml:11:19: unknown name 'q'"},
           {"max(p, 0)^1.5", "both(p, 1)", "'hertz' is defined by itself: hertz -> both -> hertz"},
           {"max(p, 0)^1.5", "p < 0", "m.toml:11:15: a condition stands where a number is needed"},
           {"\"hertz(p)\"", "\"hertz\"", "m.toml:11: 'hertz' must name its arguments, in quotes"},
           {"\"hertz(p)\"", "\"hertz()\"", "m.toml:11: '' cannot be a name"},
           {"\"hertz(p)\"", "\"hertz(p, p)\"", "m.toml:11: 'p' is defined twice"},
           {"\"hertz(p)\"", "\"exp(p)\"", "m.toml:11: 'exp' has a meaning of its own"},
           {"\"hertz(p)\"", "\"omega(p)\"", "m.toml:11: 'omega' is defined twice"},
           {"e[i]", "e[i + 1]", "there is no 'e[4]'; the first entry of a list is [1]"},
           {"e[i]", "e[x]", "a whole number must stand here"},
           {"e[i]", "e[1 cos", "']' is missing"},
           {"sum(i, 1, 3", "sum(i, 1, omega", "a whole number must stand here"},
           {"sum(i, 1, 3, e[i]", "sum(i, 1, 1e9, x",
            "more than 256 operations follow one from another"},
           {"sum(i, 1, 3,", "sum(i, 1, 3", "a sum is written sum(i, 1, 3, term)"},
           {"sum(i, 1, 3,", "sum(3, 1, 3,", "a sum is written sum(i, 1, 3, term)"},
           {"[1.0, 2.0]", "[1.0, 20.0]", "m.toml:9: w_2 = 20 is out of range"},
           {"[1.0, 2.0]", "[]", "m.toml:9: a list has 1 to 64 values"},
           {"omega = 0.9", "omega = 0.9\ne_2 = 1.0", "'e_2' is defined twice"},
       }) {
    const std::string text = replaced(kShort, mistake.from, mistake.to);
    ASSERT_NE(text, kShort) << mistake.from;
    try {
      read_model_text(text, "m.toml");
      ADD_FAILURE() << mistake.to;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(mistake.message));
    }
  }
}

// Each of these would take for ever, or a deep stack, if all was read that is written.
TEST(ModelFunctions, HostileDefinitionsAreReadAtOnce) {
  const auto model_with = [](const std::string& functions, const std::string& equation) {
    return "[model]\nname = 'deep'\n[states]\nx = {}\n[parameters]\nomega = 1.0\n[functions]\n" +
           functions + "[equations]\nx = '" + equation + "'\n[forcing]\nperiod = '2*pi/omega'\n";
  };
  std::string doubled = "'f0(p)' = 'p'\n", chained = doubled;
  for (int i = 1; i <= 14; ++i) {
    doubled += fmt::format("'f{}(p)' = 'f{}(p) + f{}(p)'\n", i, i - 1, i - 1);
  }
  const std::string parentheses(250, '(');
  for (int i = 1; i <= 200; ++i) {
    chained += fmt::format("'f{}(p)' = '{}f{}(p){}'\n", i, parentheses, i - 1,
                           std::string(parentheses.size(), ')'));
  }
  EXPECT_NO_THROW(read_model_text(model_with(doubled, "f14(x)"), "m.toml"));
  // 2^100 as an index: its parts are shared.
  std::string called = "1";
  for (int i = 0; i < 100; ++i) called = "f1(" + called + ")";
  EXPECT_THROW(read_model_text(model_with(doubled, "e[" + called + "]"), "m.toml"), InputError);
  for (const std::string& text :
       {model_with(chained, "f200(x)"), model_with(doubled, "f14(x) + f15(x)"),
        model_with("", "sum(i, 1, 999, sum(j, 1, 999, sum(k, 1, 999, x)))"),
        model_with("'g(p)' = 'sum(i, 1, 999, p)'\n'f(p)' = 'sum(i, 1, 999, g(p + i))'\n",
                   "sum(i, 1, 999, f(i))")}) {
    EXPECT_THROW(read_model_text(text, "m.toml"), InputError);
  }
}

TEST(ModelFunctions, OneThatNothingCallsIsTold) {
  const std::string text = replaced(kShort, "both(2*x, 0.2)", "x");
  const auto model = read_model_text(text, "m.toml");
  std::vector<std::string> unused;
  for (const UnusedName& one : model->unused) unused.push_back(one.kind + " " + one.name);
  EXPECT_THAT(unused, ::testing::UnorderedElementsAre("function hertz", "function both"));
}

}  // namespace
}  // namespace gearsweep::testing
