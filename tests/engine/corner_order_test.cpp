// Steps in which a limit of a stop or a backlash is crossed keep the integrator's order, whatever
// the model's equations make of it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

struct Case {
  std::string name;
  std::string states, constants, equations;
  // At least. A crossing leaves an error of fourth order in the motion, and of third order in its
  // derivative along a tangent vector.
  double order = 3.5;
  double tangent_order = 2.7;

  friend void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }
};

const std::vector<Case> kCases = {
    {.name = "stop",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"stop(x, b)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 9*f\"\n"},
    {.name = "moving_stop",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"stop(x, b*(1 + 0.3*cos(phase)))\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 9*(1 + 0.4*cos(phase))*f\"\n"},
    {.name = "two_flanks_of_their_own",
     .states = "x = {}\nv = {}\n",
     .constants = "drive = \"stop(x, b)\"\ncoast = \"stop(-x, 0.6*b)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) - 0.1*v - 0.2*x - 9*drive + 4*coast\"\n"},
    {.name = "two_backlashes",
     .states = "x = {}\ny = {}\nv = {}\nw = {}\n",
     .constants = "f = \"backlash(x - y, b)\"\ng = \"backlash(y, 0.5*b)\"\n",
     .equations = "x = \"v\"\ny = \"w\"\nv = \"F*sin(phase) + 0.1 - 0.1*v - 5*f\"\n"
                  "w = \"5*f - 8*g - 0.2*w\"\n"},
    {.name = "limit_that_bends_with_the_states",
     .states = "x = {}\ny = {}\nv = {}\nw = {}\n",
     .constants = "r = \"sqrt((0.3 + x)^2 + y^2)\"\nf = \"stop(r, b)/r\"\n",
     .equations = "x = \"v\"\ny = \"w\"\nv = \"F*cos(phase) - x - 0.1*v - 8*f*(0.3 + x)\"\n"
                  "w = \"F*sin(phase) - y - 0.1*w - 8*f*y\"\n"},
    {.name = "force_that_the_velocity_turns",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"stop(x, b)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 9*f*(1 + 0.4*tanh(2*v))\"\n"},
    {.name = "force_that_feeds_its_own_penetration",
     .states = "x = {}\ny = {}\nz = {}\n",
     .constants = "f = \"backlash(x, b)\"\n",
     .equations = "x = \"2*(y - x) + 1.5*x - 2*f + F*sin(phase)\"\ny = \"x - y + z\"\n"
                  "z = \"-3*y\"\n",
     .order = 2.7},  // what the force does to its penetration is followed to first order
    {.name = "damper_behind_a_stop",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"stop(x + 0.2*v, b)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 9*f\"\n"},
    {.name = "force_that_stiffens",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"stop(x, b)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 9*f - 5*f^2\"\n",
     .order = 2.7,  // the jump of the force's second derivative is left alone
     .tangent_order = 1.7},
    // Not abs(x): the motion starts at 0, and on a corner a tangent vector has no slope of its own.
    {.name = "abs_and_a_choice_that_meets",
     .states = "x = {}\nv = {}\n",
     .constants = "f = \"if(x > b, 9*(x - b), 0)\"\n",
     .equations = "x = \"v\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - 0.5*abs(4*x - 0.2)/4 - f\"\n"},
    {.name = "nested_corners",
     .states = "x = {}\ny = {}\nv = {}\nw = {}\n",
     .constants = "r = \"max(abs(x), abs(y)) - 0.3*b\"\nf = \"9*max(r, 0)\"\n",
     .equations = "x = \"v\"\ny = \"w\"\nv = \"F*sin(phase) + 0.2 - 0.1*v - x - f*x\"\n"
                  "w = \"F*cos(phase) - 0.2*w - 1.3*y - f*y\"\n",
     .order = 2.7,  // two corners that lie in one step are not told apart
     .tangent_order = 1.7},
    {.name = "saturated_network",
     .states = "x = {}\ny = {}\nz = {}\n",
     .constants = "f = \"clamp(x, -b, b)\"\ng = \"clamp(y, -b, b)\"\n",
     .equations = "x = \"-x + 2*f - 1.5*g + F*sin(phase)\"\ny = \"-y + 1.8*f + 1.2*g - z\"\n"
                  "z = \"-z + 2*g\"\n",
     .order = 2.7},  // as above: forces that feed their own penetrations
};

class Corners : public ::testing::TestWithParam<Case> {};

std::string study_of(const Case& tested) {
  return "[model]\ntext = '''\n[model]\nname = \"tested\"\n[states]\n" + tested.states +
         "[parameters]\nF = 0.6\nb = 0.4\nomega = 0.8\n[constants]\n" + tested.constants +
         "[equations]\n" + tested.equations + "[forcing]\nperiod = \"2*pi/omega\"\n'''\n" +
         "[[axes]]\nname = 'omega'\nfrom = 0.61\nto = 1.03\ncount = 64\n"
         "[initial]\npolicy = 'fixed'\n"
         "[integrate]\nsettle = 0\nrecord = 4\nextend = 1\nstop = 'never'\nwarm_up = 0\n"
         "[observe]\nquantities = ['x_rms', 'lyapunov_max']\n";
}

// By how much the mean error over the points falls with each halving of the step, from 0.08 to
// 0.01: the order of one pair of steps depends on where in its step each crossing falls.
double order_of(const std::string& study, std::size_t map) {
  const auto values = [&](double step) {
    return run(study, {"integrate.max_step=" + std::to_string(step)}).values[map];
  };
  const std::vector<double> fine = values(0.00125);
  const auto error = [&](double step) {
    const std::vector<double> found = values(step);
    double sum = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) sum += std::abs(found[i] - fine[i]);
    return sum;
  };
  return std::log2(error(0.08) / error(0.01)) / 3.0;
}

TEST_P(Corners, KeepTheOrderOfTheMotion) {
  const double order = order_of(study_of(GetParam()), 0);
  EXPECT_GT(order, GetParam().order);
}

TEST_P(Corners, KeepTheOrderOfTangents) {
  const double order = order_of(study_of(GetParam()), 1);
  EXPECT_GT(order, GetParam().tangent_order);
}

// Without the correction it is lost: these motions do cross the limits. For the steps without it
// the reference engine does, which has nothing to compile.
TEST_P(Corners, WouldLoseItUncorrected) {
  const std::string study = study_of(GetParam());
  const auto off = [&](double step) {
    return run(study,
               {"integrate.events=false", "integrate.engine='reference'",
                "observe.quantities=['x_rms']", "integrate.max_step=" + std::to_string(step)})
        .values[0];
  };
  const std::vector<double> fine = run(study, {"integrate.max_step=0.002"}).values[0];
  const std::vector<double> on = run(study, {"integrate.max_step=0.03"}).values[0];
  const std::vector<double> without = off(0.03);
  double error = 0.0, error_without = 0.0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    error += std::abs(on[i] - fine[i]);
    error_without += std::abs(without[i] - fine[i]);
  }
  EXPECT_GT(error_without, 3.0 * error);
}

// The reference engine has the same correction by another program.
TEST_P(Corners, AreCorrectedByTheHostAlike) {
  const std::string study = study_of(GetParam());
  const SweepResult device = run(study, {"integrate.max_step=0.05"});
  const SweepResult host =
      run(study, {"integrate.max_step=0.05", "integrate.engine=\"reference\""});
  for (std::size_t map = 0; map < device.values.size(); ++map) {
    for (std::size_t i = 0; i < device.status.size(); ++i) {
      EXPECT_NEAR(device.values[map][i], host.values[map][i], 1e-8) << map << " " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Corners, ::testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gearsweep::testing
