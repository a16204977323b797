// Draws that start from the motion of the nominal parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// A hardening oscillator that a force of 2 takes to its upper motion, and the smaller forces of the
// draws, from rest, to the lower one.
std::string hardening(const std::string& start) {
  return "[model]\ntext = '''\n[model]\nname = \"hardening\"\n[states]\nx = {}\nv = {}\n"
         "[parameters]\nF = 2.0\nc = 0.1\n[equations]\nx = \"v\"\nv = \"-c*v - x - x^3 + "
         "F*cos(phase)\"\n[forcing]\nperiod = \"2*pi/1.8\"\n'''\n[observe]\nquantities = "
         "['x_max']\n[integrate]\nmax_step = 0.01\nrecord = 8\n[uncertain]\nsamples = 12\nkeep = "
         "true\nF = {values = [1.2, 1.0, 0.8, 0.5]}\nstart = '" +
         start + "'\n";
}

void expect_amplitudes(const std::string& start, const std::map<double, double>& expected) {
  const SweepResult result = run(hardening(start));
  EXPECT_NEAR(map_of(result, "x_max").front(), 2.11722, 1e-4);
  const std::vector<double>& amplitudes = map_of(result, "x_max_draws");
  const Axis& force = result.study.uncertain.parameters.front().draws;
  ASSERT_EQ(amplitudes.size(), force.values.size());
  for (std::size_t draw = 0; draw < amplitudes.size(); ++draw) {
    EXPECT_NEAR(amplitudes[draw], expected.at(force.values[draw]), 1e-4) << force.values[draw];
  }
}

// Amplitudes by SciPy (solve_ivp, tolerance 1e-9, 300 periods from rest).
TEST(NominalStart, OwnStartsReachTheLowerMotion) {
  expect_amplitudes("own", {{1.2, 0.61161}, {1.0, 0.48342}, {0.8, 0.37379}, {0.5, 0.22646}});
}

// The same from the end of the motion at a force of 2.
TEST(NominalStart, DrawsFollowTheNominalMotion) {
  expect_amplitudes("nominal", {{1.2, 1.98537}, {1.0, 1.94823}, {0.8, 1.90845}, {0.5, 1.83936}});
}

// A gear whose load keeps its teeth together has one motion.
TEST(NominalStart, GivesTheSameMapsWhereOneMotionIsPossible) {
  const std::string gears =
      "[model]\npreset = 'consistent'\n[parameters]\nF1 = 0.5\n[[axes]]\nname = 'omega'\nfrom = "
      "0.6\nto = 1.4\ncount = 5\n"
      "[integrate]\nmax_step = 0.1\n[observe]\nquantities = ['dmf_max', 'contact_class']\n"
      "[uncertain]\nsamples = 40\nF1 = {distribution = 'normal', std = 0.002}\n"
      "e0 = {distribution = 'normal', std = 0.004}\nstart = ";
  const SweepResult own = run(gears + "'own'\n");
  const SweepResult nominal = run(gears + "'nominal'\n");
  for (const char* name : {"dmf_max_p5", "dmf_max_p50", "dmf_max_p95", "dmf_max_sample_std"}) {
    const std::vector<double>& expected = map_of(own, name);
    for (std::size_t point = 0; point < expected.size(); ++point) {
      EXPECT_NEAR(map_of(nominal, name)[point], expected[point], 1e-5) << name << " " << point;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
