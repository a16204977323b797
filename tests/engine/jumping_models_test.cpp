// Models with one kind of jump each: the order of the method, and the other engine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

struct Jumping {
  std::string name, states, equations;

  friend void PrintTo(const Jumping& tested, std::ostream* out) { *out << tested.name; }
};

const std::vector<Jumping> kJumping = {
    {.name = "stairs",
     .states = "x = { start = '0.3' }\nv = { start = '0.2' }\n",
     .equations = "x = \"v\"\nv = \"3*cos(phase) - 0.2*v - floor(2*x)\"\n"},
    {.name = "a_belt_that_shakes",
     .states = "x = { start = '0.3' }\nv = { start = '0.2' }\n",
     .equations = "x = \"v\"\n"
                  "v = \"cos(phase) - 0.1*v - x - 0.4*sign(v - 0.5*sin(2*phase))\"\n"},
    {.name = "two_that_stick",
     .states = "x = {}\ny = {}\nv = { start = '0.3' }\nu = { start = '-0.2' }\n",
     .equations = "x = \"v\"\ny = \"u\"\n"
                  "v = \"1.2*cos(phase) - 0.05*v - 2*x + y - 0.4*sign(v)\"\n"
                  "u = \"x - 2*y - 0.05*u - 0.28*sign(u)\"\n"},
    {.name = "friction_and_a_stop",
     .states = "x = { start = '0.1' }\nv = { start = '0.3' }\n",
     .equations = "x = \"v\"\nv = \"cos(phase) - 0.1*v - x - 4*stop(x, 0.3) - 0.2*sign(v)\"\n"},
    {.name = "a_surface_that_bends",
     .states = "x = { start = '0.6' }\nv = { start = '0.2' }\n",
     .equations = "x = \"v\"\n"
                  "v = \"cos(phase) - 0.1*v - x - 0.5*sign(x^2 + v^2 - 0.8)*v\"\n"},
    // A reset takes v to the other side of the jump.
    {.name = "friction_and_a_wall",
     .states = "x = { start = '0.1' }\nv = { start = '0.3' }\n",
     .equations = "x = \"v\"\nv = \"cos(phase) - 0.1*v - x - 0.3*sign(v)\"\n"
                  "[surfaces.wall]\nwhen = \"x - 0.4\"\nreset = { v = \"-0.8*v\" }\n"},
    // A reset lifts the other state, now and then above its own threshold.
    {.name = "neurons",
     .states = "x = { start = '0.1' }\nv = { start = '0.5' }\n",
     .equations =
         "x = \"1.3 + 0.2*cos(phase) - x\"\nv = \"1.2 - v\"\n"
         "[surfaces.one]\nwhen = \"x - 1\"\nreset = { x = \"0\", v = \"v + 0.3\" }\n"
         "[surfaces.other]\nwhen = \"v - 1\"\nreset = { v = \"0.1*v\", x = \"x + 0.2\" }\n"}};

class JumpingModels : public ::testing::TestWithParam<Jumping> {
 protected:
  static SweepResult at(std::size_t steps, const std::string& engine = "opencl") {
    const std::string model = "[model]\nname = \"tested\"\n[states]\n" + GetParam().states +
                              "[parameters]\nomega = 0.7\n[equations]\n" + GetParam().equations +
                              "[forcing]\nperiod = \"2*pi/omega\"\n";
    return run(
        study_of_text(model, fmt::format("[[axes]]\nname = 'omega'\nfrom = 0.6\nto = 0.8\n"
                                         "count = 16\n[integrate]\nsettle = 0\nrecord = 3\n"
                                         "stop = 'never'\nwarm_up = 0\nsteps_per_period = {}\n"
                                         "engine = '{}'\n[observe]\npoincare = ['x', 'v']\n"
                                         "quantities = ['x_rms', 'lyapunov_max', 'poincare']\n",
                                         steps, engine)));
  }
  static double difference(const SweepResult& a, const SweepResult& b, const char* map) {
    double sum = 0.0;
    for (std::size_t i = 0; i < map_of(a, map).size(); ++i) {
      sum += std::fabs(map_of(a, map)[i] - map_of(b, map)[i]);
    }
    return sum;
  }
};

TEST_P(JumpingModels, KeepTheOrderOfMotionAndTangents) {
  const SweepResult fine = at(3840), coarse = at(120), finer = at(960);
  for (const char* map : {"x_rms", "lyapunov_max"}) {
    EXPECT_GT(std::log2(difference(coarse, fine, map) / difference(finer, fine, map)) / 3.0, 2.7)
        << map;
  }
}

// The reference engine finds the crossings by halving, with steps to each place: the two differ by
// errors of fourth order, and in an exponent of three periods by those of tangent vectors.
TEST_P(JumpingModels, AreTheSameByTheOtherEngine) {
  const SweepResult device = at(480), host = at(480, "reference");
  for (std::size_t state = 0; state < 2; ++state) {
    for (std::size_t point = 0; point < device.study.points(); ++point) {
      for (std::size_t period = 0; period < 3; ++period) {
        EXPECT_NEAR(samples_of(device, point, state)[period],
                    samples_of(host, point, state)[period], 1e-5);
      }
    }
  }
  EXPECT_LT(difference(device, host, "lyapunov_max"), 1e-3);
  EXPECT_LT(difference(device, host, "x_rms"), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Models, JumpingModels, ::testing::ValuesIn(kJumping),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gearsweep::testing
