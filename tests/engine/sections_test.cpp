// Sections: places that a motion is looked at where it comes up through them, in models with a
// clock and without one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "study/builtin_models.hpp"
#include "study/refusal.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

const std::string kReturns =
    "[observe]\nquantities = ['top_returns', 'top_return_time', 'top_return_time_min', "
    "'top_return_time_max', 'top_period', 'top_cycle_time', 'poincare']\nsection = 'top'\n";

std::string section_study(const std::string& model, const std::string& section,
                          const std::string& axis, const std::string& integrate,
                          const std::string& rest = "") {
  return fmt::format("[model]\n{}\n[sections.top]\n{}\n[[axes]]\n{}\n[integrate]\n{}\n{}{}", model,
                     section, axis, integrate, rest, kReturns);
}

// With a clock, so that records and samples are by the time.
std::string rossler(const std::string& axis, const std::string& integrate,
                    const std::string& rest = "") {
  const std::string text = find_model("rossler")->text + "[forcing]\nperiod = 1.0\n";
  return section_study("text = '''" + text + "'''", "maximum_of = 'x'", axis, integrate, rest);
}

// Maxima of x from x = y = 1, z = 0.5 with c = 5.7, by DOP853 (E. Hairer, S. P. Norsett, G. Wanner,
// Solving Ordinary Differential Equations I, 1993) with located events, tolerance 1e-13.
constexpr std::array kMaxima = {2.49122043, 4.56613313,  8.1651103,   11.33413013,
                                3.84082576, 6.95879045,  11.12806961, 4.39809327,
                                7.89336304, 11.42265879, 3.63012209,  6.59476852};

TEST(Sections, AreOfTheOrderOfTheMethod) {
  const auto error = [](double step) {
    const SweepResult result =
        run(rossler("name = 'c'\nvalues = [5.7]",
                    fmt::format("settle = 0\nrecord = 72\n"
                                "max_step = {}\nstop = 'never'",
                                step),
                    "[initial]\npolicy = 'fixed'\nstate = { x = 1.0, y = 1.0, z = 0.5 }\n"));
    double worst = 0.0;
    for (std::size_t i = 0; i < kMaxima.size(); ++i) {
      worst = std::max(worst, std::abs(samples_of(result, 0, 0)[i] - kMaxima[i]));
    }
    EXPECT_NEAR(map_of(result, "top_return_time")[0], (70.43588102 - 5.49868194) / 11.0, worst);
    return worst;
  };
  const double coarse = error(0.08), fine = error(0.01);
  EXPECT_LT(fine, 3e-6);
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.7);
}

// The band doubles its period: times by the same integrator.
TEST(Sections, GiveThePeriodOfACycleWithoutAClock) {
  const SweepResult result = run(rossler("name = 'c'\nvalues = [2.5, 3.5, 4.0, 5.7]",
                                         "settle = 2000\nrecord = 2000\nmax_step = 0.02"));
  const auto& periods = map_of(result, "top_period");
  const auto& times = map_of(result, "top_cycle_time");
  EXPECT_THAT(periods, ::testing::ElementsAre(1.0, 2.0, 4.0, 0.0));
  EXPECT_NEAR(times[0], 5.748991183, 1e-8);
  EXPECT_NEAR(times[1], 11.545218288, 1e-6);
  EXPECT_NEAR(times[2], 23.177001056, 1e-6);
  EXPECT_TRUE(std::isnan(times[3]));
  // So many come in the record, and no more.
  const auto returns = static_cast<std::size_t>(std::lround(2000.0 * 0.174));
  EXPECT_FALSE(std::isnan(samples_of(result, 0, 0)[returns - 1]));
  EXPECT_TRUE(std::isnan(samples_of(result, 0, 0)[returns + 1]));
}

// In the steady state x = a cos(phase - lag), which comes up through every level within a once in a
// period.
TEST(Sections, MayLieAnywhereInStateAndPhase) {
  const std::string linear = R"(text = """
[model]
name = "linear"
[states]
x = {}
v = {}
[parameters]
omega = 1.3
at = 0.0
[equations]
x = "v"
v = "cos(phase) - x - 0.4*v"
[forcing]
period = "2*pi/omega"
""")";
  const double w = 1.3, a = 1.0 / std::hypot(1.0 - w * w, 0.4 * w);
  const SweepResult result =
      run(section_study(linear, "when = 'x - at'", "name = 'at'\nfrom = -0.6\nto = 0.6\ncount = 8",
                        "settle = 60\nrecord = 8\nsteps_per_period = 200"));
  for (std::size_t i = 0; i < 8; ++i) {
    const double level = -0.6 + 1.2 * static_cast<double>(i) / 7.0;
    EXPECT_EQ(map_of(result, "top_returns")[i], 1.0);
    EXPECT_NEAR(map_of(result, "top_cycle_time")[i], 2.0 * std::numbers::pi / w, 1e-9);
    EXPECT_NEAR(samples_of(result, i, 0)[3], level, 1e-8);
    EXPECT_LT(std::abs(level), a);
  }
}

// At the wall x' jumps from above 0 to below it: a maximum that no rate passes through. Between
// the resonances there is one impact in two periods.
TEST(Sections, SeeAMaximumThatIsACorner) {
  const SweepResult result = run(section_study(
      "name = 'hard_impact'", "maximum_of = 'x'", "name = 'omega'\nvalues = [3.9, 4.0]",
      "settle = 600\nrecord = 40\nsteps_per_period = 100"));
  for (std::size_t i = 0; i < 2; ++i) {
    const double omega = 3.9 + 0.1 * static_cast<double>(i);
    EXPECT_NEAR(map_of(result, "top_returns")[i], 0.5, 1e-12);
    EXPECT_NEAR(map_of(result, "top_return_time")[i], 4.0 * std::numbers::pi / omega, 1e-8);
    EXPECT_NEAR(samples_of(result, i, 0)[5], 0.0, 1e-12);
  }
}

struct Sectioned {
  const char *model, *section, *axis;
  double tolerance;  // of the engines: what is left of errors of fourth order
};

// The reference engine halves whole steps of the method to come to a section.
TEST(Sections, AreTheSameInBothEnginesAndInEachLane) {
  const std::array cases = {
      Sectioned{"duffing", "when = 'v'\ndirection = 'down'", "name = 'x'\nfrom = 0.5\nto = 1.5",
                1e-5},
      Sectioned{"coulomb", "maximum_of = 'v'", "name = 'omega'\nfrom = 0.5\nto = 1.5", 1e-6},
      Sectioned{"hard_impact", "when = 'x + 0.3*cos(phase) + 0.2'",
                "name = 'x'\nfrom = -1\nto = -0.1", 1e-6},
      Sectioned{"gear1", "maximum_of = 'x'", "name = 'omega'\nfrom = 0.5\nto = 1.5", 1e-6},
      Sectioned{"pendulum", "when = 'sin(x)'", "name = 'x'\nfrom = 0.5\nto = 1.5", 1e-5},
  };
  for (const Sectioned& one : cases) {
    SCOPED_TRACE(one.model);
    const std::string study = section_study(
        fmt::format("name = '{}'", one.model), one.section, fmt::format("{}\ncount = 8", one.axis),
        "settle = 0\nrecord = 3\nsteps_per_period = 128\nstop = 'never'");
    const SweepResult kernel = run(study, {"integrate.lanes=8"});
    const SweepResult reference = run(study, {"integrate.engine=reference"});
    const SweepResult alone = run(study, {"integrate.lanes=1"});
    for (std::size_t q = 0; q < kernel.values.size(); ++q) {
      for (std::size_t i = 0; i < kernel.status.size(); ++i) {
        const double value = kernel.values[q][i], other = reference.values[q][i];
        ASSERT_EQ(std::isnan(value), std::isnan(other));
        if (std::isnan(value)) continue;
        EXPECT_NEAR(value, other, one.tolerance);
        EXPECT_EQ(value, alone.values[q][i]);
      }
    }
    for (std::size_t i = 0; i < kernel.samples.size(); ++i) {
      ASSERT_EQ(std::isnan(kernel.samples[i]), std::isnan(reference.samples[i]));
      if (std::isnan(kernel.samples[i])) continue;
      EXPECT_NEAR(kernel.samples[i], reference.samples[i], one.tolerance);
      EXPECT_EQ(kernel.samples[i], alone.samples[i]);
    }
  }
}

// What is not looked at changes nothing.
TEST(Sections, LeaveTheMotionAsItIs) {
  const std::string model = "[model]\nname = 'duffing'\n";
  const std::string rest =
      "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 8\n[integrate]\nsettle = 10\n"
      "record = 5\nstop = 'never'\n[observe]\nquantities = ['x_max', 'x_rms'";
  const SweepResult bare = run(model + rest + "]\n");
  const SweepResult watched =
      run(model + "[sections.top]\nwhen = 'v'\n" + rest + ", 'top_returns']\n");
  EXPECT_EQ(map_of(bare, "x_max"), map_of(watched, "x_max"));
  EXPECT_EQ(map_of(bare, "x_rms"), map_of(watched, "x_rms"));
}

// log(x) is no number where x is negative.
TEST(Sections, OfAnUndefinedPlaceHaveNoReturns) {
  const std::string study = section_study("name = 'duffing'", "when = 'log(x)'",
                                          "name = 'x'\nfrom = 0.5\nto = 1.5\ncount = 4",
                                          "settle = 0\nrecord = 4\nstop = 'never'");
  for (const char* const engine : {"opencl", "reference"}) {
    const SweepResult result = run(study, {std::string("integrate.engine=") + engine});
    for (const char* const quantity : {"top_returns", "top_return_time", "top_period"}) {
      for (const double value : map_of(result, quantity)) EXPECT_TRUE(std::isnan(value)) << engine;
    }
  }
}

TEST(Sections, SayWhatIsWrongWithThem) {
  const auto refused = [](const std::string& section, const std::string& observe = kReturns) {
    return refusal("[model]\nname = 'duffing'\n" + section +
                   "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 8\n" + observe);
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("[sections.top]\n"), HasSubstr("says not where it is"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'v'\nmaximum_of = 'x'\n"), HasSubstr("given twice"));
  EXPECT_THAT(refused("[sections.top]\nmaximum_of = 'x'\ndirection = 'up'\n"),
              HasSubstr("has no direction"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'v'\ndirection = 'left'\n"), HasSubstr("'left'"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'y'\n"), HasSubstr("unknown name 'y'"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'cos(phase)'\n"), HasSubstr("lies nowhere"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'sign(x)'\n"), HasSubstr("may jump"));
  EXPECT_THAT(refused("[sections.'a b']\nwhen = 'v'\n"), HasSubstr("cannot be a name"));
  EXPECT_THAT(refused("[sections.top]\nwhere = 'v'\n"), HasSubstr("'top'"));
  EXPECT_THAT(refused("[sections]\ntop = 'v'\n"), HasSubstr("must be a table"));
  EXPECT_THAT(refused("", "[observe]\nquantities = ['top_returns']\n"),
              HasSubstr("unknown quantity 'top_returns'"));
  EXPECT_THAT(refused("", "[observe]\nsection = 'top'\n"), HasSubstr("has no sections"));
  EXPECT_THAT(refused("[sections.top]\nwhen = 'v'\n", "[observe]\nsection = 'tap'\n"),
              HasSubstr("'top'"));
}

}  // namespace
}  // namespace gearsweep::testing
