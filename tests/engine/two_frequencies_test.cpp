// Models with a second frequency: their motions return nowhere, and the phase has no exponent.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "study/refusal.hpp"
#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The exponents of a point.
std::vector<double> spectrum_of(const SweepResult& result, std::size_t point) {
  const std::vector<double>& all = map_of(result, "lyapunov_spectrum");
  const std::size_t width = all.size() / 3;
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(point * width);
  return {first, first + static_cast<std::ptrdiff_t>(width)};
}

constexpr double kDamping = 0.2, kFirst = 1.0, kSecond = 0.7;

// x'' = -c x' - x + cos(omega t) + 0.7 cos(omega2 t), with the phase of omega2 in `name`. size,
// unit: of lengths and times.
std::string driven_twice(const std::string& rest, double size = 1.0, double unit = 1.0) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "twice"
[states]
x = {{}}
v = {{}}
[parameters]
omega = {0}
omega2 = {0}
c = {1}
F = {2}
G = {3}
k = {4}
[forcing]
period = "2*pi/omega"
second = "omega2"
[equations]
x = "v"
v = "-c*v - k*x + F*cos(phase) + G*cos(phase2)"
"""
[[axes]]
name = "omega2"
values = [{5}, {6}, {7}]
{8})toml",
                     1.0 / unit, kDamping / unit, kFirst * size / (unit * unit),
                     kSecond * size / (unit * unit), 1.0 / (unit * unit), 0.5 / unit,
                     std::sqrt(0.5) / unit, 2.0 / unit, rest);
}

double amplitude(double force, double omega) {
  return force / std::abs(std::complex(1.0 - omega * omega, kDamping * omega));
}

TEST(TwoFrequencies, TheLinearAnswerIsTheSumOfBothInAnyUnits) {
  for (const auto& [size, unit] : {std::pair(1.0, 1.0), {1e-6, 1e-3}, {1e3, 1e5}}) {
    SCOPED_TRACE(unit);
    const SweepResult result = run(driven_twice(R"toml([integrate]
settle = 100
record = 2000
[observe]
quantities = ["x_max", "x_rms", "lyapunov_spectrum", "kaplan_yorke", "motion_class", "period"]
)toml",
                                                size, unit));
    const double first = amplitude(kFirst, 1.0), second = amplitude(kSecond, std::sqrt(0.5));
    EXPECT_NEAR(map_of(result, "x_max")[1] / size, first + second, 1e-3);
    EXPECT_NEAR(map_of(result, "x_rms")[1] / size, std::hypot(first, second) / std::sqrt(2.0),
                1e-3);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<double> spectrum = spectrum_of(result, i);
      ASSERT_EQ(spectrum.size(), 2U);  // none of the second phase
      // A vector that turns is longer or shorter by the ratio of the units where a record ends.
      EXPECT_NEAR(spectrum[0] * unit, -0.5 * kDamping, 5e-4);
      EXPECT_NEAR(spectrum[1] * unit, -0.5 * kDamping, 5e-4);
      EXPECT_NEAR((spectrum[0] + spectrum[1]) * unit, -kDamping, 1e-6);
    }
    // Two frequencies whose ratio is whole agree after some periods.
    EXPECT_THAT(map_of(result, "period"), ElementsAre(2.0, 0.0, 1.0));
    EXPECT_THAT(map_of(result, "motion_class"),
                ElementsAre(MOTION_periodic, MOTION_quasi_periodic, MOTION_periodic));
    // The section of a torus is a curve.
    EXPECT_DOUBLE_EQ(map_of(result, "kaplan_yorke")[1], 1.0);
  }
}

// Chaos, whose forcing jumps with the second phase. theta: the name of that phase; more: what makes
// it.
std::string jumping_duffing(const std::string& theta, const std::string& state,
                            const std::string& forcing, const std::string& equation) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "wells"
[states]
x = {{ start = "0.1" }}
v = {{}}
{1}
[parameters]
F = 0.3
omega2 = 1.618033988749895
[forcing]
period = "2*pi"
{2}
[equations]
x = "v"
v = "-0.2*v + x - x^3 + F*cos(phase) + 0.15*cos({0} - phase) + 0.2*sign(sin({0}))"
{3}
"""
[[axes]]
name = "F"
values = [0.05, 0.3, 0.4]
[integrate]
settle = 100
record = 400
[observe]
quantities = ["x_max", "x_rms", "lyapunov_max", "lyapunov_spectrum", "kaplan_yorke", "poincare"]
poincare = ["x", "{0}"]
)toml",
                     theta, state, forcing, equation);
}

TEST(TwoFrequencies, AreAStateThatTurnsWithoutItsExponent) {
  const SweepResult own = run(jumping_duffing("phase2", "", "second = \"omega2\"", ""));
  const SweepResult by_hand =
      run(jumping_duffing("theta", "theta = { angle = true }", "", "theta = \"omega2\""));
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    // Bits: both are integrated in the same way.
    EXPECT_EQ(samples_of(own, i, 0), samples_of(by_hand, i, 0));
    EXPECT_EQ(samples_of(own, i, 1), samples_of(by_hand, i, 1));
    EXPECT_DOUBLE_EQ(map_of(own, "x_rms")[i], map_of(by_hand, "x_rms")[i]);
    const std::vector<double> two = spectrum_of(own, i);
    const std::vector<double> three = spectrum_of(by_hand, i);
    ASSERT_EQ(two.size(), 2U);
    ASSERT_EQ(three.size(), 3U);
    const std::size_t zero = two[0] > 0.0 ? 1 : 0;
    EXPECT_NEAR(three[zero], 0.0, 1e-3);
    EXPECT_NEAR(three[zero == 0 ? 1 : 0], two[0], 2e-3);
    EXPECT_NEAR(three[2], two[1], 2e-3);
    EXPECT_NEAR(map_of(own, "kaplan_yorke")[i], zero == 0 ? 1.0 : 2.0 + two[0] / -two[1], 1e-12);
  }
}

TEST(TwoFrequencies, AreTheSameInTheReferenceEngine) {
  const std::string study = driven_twice(R"toml([integrate]
settle = 20
record = 100
[observe]
quantities = ["x_max", "x_rms", "lyapunov_spectrum", "kaplan_yorke", "motion_class"]
)toml");
  const SweepResult ours = run(study), theirs = run(study, {"integrate.engine=reference"});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(map_of(ours, "x_max")[i], map_of(theirs, "x_max")[i], 1e-11);
    EXPECT_NEAR(map_of(ours, "kaplan_yorke")[i], map_of(theirs, "kaplan_yorke")[i], 1e-11);
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(spectrum_of(ours, i)[j], spectrum_of(theirs, i)[j], 1e-11);
    }
  }
  EXPECT_EQ(map_of(ours, "motion_class"), map_of(theirs, "motion_class"));
}

std::string refusal_of(const std::string& from, const std::string& to) {
  std::string text = driven_twice("");
  text.replace(text.find(from), from.size(), to);
  return refusal(text);
}

TEST(TwoFrequencies, RefuseWhatWouldNotTurnSteadily) {
  EXPECT_THAT(refusal_of("second = \"omega2\"", "second = \"omega2*x\""),
              HasSubstr("the second frequency"));
  EXPECT_THAT(refusal_of("cos(phase2)", "cos(0.5*phase2)"),
              HasSubstr("make 'second' so much slower"));
  EXPECT_THAT(refusal_of("x = {}", "x = {}\nphase2 = {}"), HasSubstr("defined twice"));
  EXPECT_THAT(refusal_of("[equations]", "[equations]\nphase2 = \"2\""), HasSubstr("phase2"));
  EXPECT_THAT(refusal_of("[forcing]",
                         "[surfaces.wall]\nwhen = \"x\"\nreset = { phase2 = \"0\" }\n[forcing]"),
              HasSubstr("'phase2' is not a state"));
  EXPECT_THAT(refusal_of("period = \"2*pi/omega\"\n", ""), HasSubstr("needs the period"));
}

}  // namespace
}  // namespace gearsweep::testing
