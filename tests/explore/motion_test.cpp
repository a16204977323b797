// What a click shows: the motion at a cell, its orbit, and where other starts lead.
#include "explore/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "explore/explored.hpp"
#include "explore/explorer.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

TEST(Motion, IsWhatARunAndATraceShowAtTheCell) {
  // So much damping, and so long, that it comes to its orbit.
  std::string text = kExplored + "[parameters]\ndamping = 0.4\n";
  text.replace(text.find("settle = 30"), 11, "settle = 300");
  Explorer explorer(explored(text), {.source = "test", .is_model = false, .devices = {}});
  const auto scene = explorer.make_scene({});
  const Motion motion = explorer.motion(*scene, {7, {40, 64}});
  const double x = scene->value_at(0, 40, 7), y = scene->value_at(1, 64, 7);
  EXPECT_EQ(motion.at[0].value, x);
  const SweepResult alone = run(scene->at({{{x}, {y}}}));
  for (std::size_t i = 0; i < alone.values.size(); ++i) {
    EXPECT_TRUE(same_bits(motion.values[i], alone.values[i][0]));
  }
  ASSERT_TRUE(motion.trace);
  EXPECT_NEAR(*std::ranges::max_element(motion.trace->values[0]), motion.values[0], 1e-3);
  ASSERT_TRUE(motion.spectrum);
  // Multipliers of a damped oscillator: their product is exp(-damping T).
  ASSERT_TRUE(motion.is_on_orbit);
  const MotionOrbit orbit = explorer.orbit(*scene, {7, {40, 64}});
  double product = 1.0;
  for (const std::complex<double>& multiplier : orbit.multipliers) {
    product *= std::abs(multiplier);
  }
  const double damping = scene->study().setting.parameters[0];
  EXPECT_NEAR(std::log(product),
              -damping * motion.trace->period * static_cast<double>(orbit.period), 1e-6);
}

// A particle in two wells: both are reached from starts around the hill between them, in any unit
// of length.
TEST(Starts, LeadToBothWells) {
  Explorer explorer(
      explored("[model]\nname = 'duffing'\n[parameters]\nlinear = -1.0\n"
               "[[axes]]\nname = 'damping'\nfrom = 0.2\nto = 0.4\ncount = 3\n"
               "[[axes]]\nname = 'omega'\nfrom = 1.0\nto = 1.4\ncount = 3\n"
               "[integrate]\nsettle = 100\nrecord = 16\n[observe]\nquantities = ['x_max']\n"),
      {.source = "test", .is_model = false, .devices = {}});
  for (const double unit : {1.0, 1e3}) {
    const auto scene = explorer.make_scene(
        {{{"cubic", 1.0 / (unit * unit)}, {"amplitude", 0.02 * unit}, {"x", 1e-3 * unit}}, "", ""});
    const ReachedAttractors reached = explorer.starts(*scene, {5, {16, 16}}, 32);
    ASSERT_EQ(reached.attractors.size(), 2U) << unit;
    for (const ReachedAttractor& attractor : reached.attractors) {
      EXPECT_GT(attractor.share, 0.2) << unit;
      EXPECT_THAT(attractor.name, ::testing::StartsWith("periodic, period 1, rms of x "));
      EXPECT_NEAR(std::abs(attractor.section.back()[0]) / unit, 1.0, 0.1);
    }
    EXPECT_NEAR(reached.attractors[0].share + reached.attractors[1].share + reached.undecided, 1.0,
                1e-12);
  }
}

// Where states are on the axes the click says where to begin, and the others begin around it.
TEST(Starts, LeadToBothWellsWhereStatesAreOnTheAxes) {
  Explorer explorer(
      explored("[model]\nname = 'duffing'\n[parameters]\nlinear = -1.0\ncubic = 1.0\n"
               "damping = 0.3\namplitude = 0.02\nomega = 1.2\n"
               "[[axes]]\nname = 'x'\nfrom = -1.0\nto = 1.0\ncount = 3\n"
               "[[axes]]\nname = 'v'\nfrom = -1.0\nto = 1.0\ncount = 3\n"
               "[integrate]\nsettle = 100\nrecord = 16\n[observe]\nquantities = ['x_max']\n"),
      {.source = "test", .is_model = false, .devices = {}});
  const ReachedAttractors reached = explorer.starts(*explorer.make_scene({}), {6, {33, 32}}, 32);
  ASSERT_EQ(reached.attractors.size(), 2U);
  EXPECT_NE(reached.attractors[0].name, reached.attractors[1].name);
}

}  // namespace
}  // namespace gearsweep::testing
