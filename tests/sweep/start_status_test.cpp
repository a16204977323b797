// What a sweep says of points that start at an equilibrium.
#include <gtest/gtest.h>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// Steady convection is unstable at rho = 28 alone; its values are there all the same.
TEST(StartStatus, TellsAnUnstableEquilibrium) {
  const std::string lorenz =
      "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [10.0, 28.0]\n[integrate]\n"
      "engine = 'reference'\nsettle = 2\nrecord = 4\n[observe]\nquantities = ['z_mean']\n";
  const SweepResult shifted = run(lorenz + "[initial]\npolicy = 'shifted'\n");
  EXPECT_EQ(shifted.status, (std::vector<std::uint8_t>{STATUS_ok, STATUS_unstable_start}));
  EXPECT_NEAR(map_of(shifted, "z_mean")[1], 27.0, 1e-9);
  // At the defaults it starts as published.
  EXPECT_EQ(run(lorenz).status, (std::vector<std::uint8_t>{STATUS_ok, STATUS_ok}));
}

// x = 0 loses its stability at g = 0, and a chain rests on it.
TEST(StartStatus, TellsOfAChainThatRestsOnOne) {
  const SweepResult chain =
      run("[model]\ntext = '''\n[model]\nname = \"pitchfork\"\n[states]\nx = {}\n[parameters]\n"
          "g = 0.0\n[equations]\nx = \"g*x - x^3\"\n[forcing]\nperiod = \"1\"\n'''\n"
          "[[axes]]\nname = 'g'\nvalues = [-1.0, -0.5, 0.5, 1.0]\n[initial]\npolicy = 'forward'\n"
          "[integrate]\nengine = 'reference'\nsettle = 2\nrecord = 4\n"
          "[observe]\nquantities = ['x_mean']\n");
  EXPECT_EQ(chain.status, (std::vector<std::uint8_t>{STATUS_ok, STATUS_ok, STATUS_unstable_start,
                                                     STATUS_unstable_start}));
}

}  // namespace
}  // namespace gearsweep::testing
