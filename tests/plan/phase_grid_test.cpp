// The steps of one period and the coefficients at them.
#include "plan/phase_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "support/mesh.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

Mesh mesh_in(const PhaseGrid& grid, const ModelSetting& setting, std::size_t row) {
  return MeshReader(gear5(), setting).of(grid.coefs.data() + row * gear5().phase_coefs.size());
}

ModelSetting with_contact_ratio(double eps) {
  ModelSetting setting = gear5().default_setting();
  set_parameter(&setting, "eps", eps);
  return setting;
}

TEST(SegmentBounds, AreTheBreakPhases) {
  // A pair leaves at eps - 1, another passes the pitch point at eps/2.
  EXPECT_THAT(segment_bounds(gear5(), with_contact_ratio(1.718)),
              ElementsAre(0.0, DoubleEq(0.718), DoubleEq(0.859), 1.0));
  ModelSetting late = with_contact_ratio(1.8);
  set_parameter(&late, "approach", 0.7);  // the pitch point at 1.26: the second pair passes it
  EXPECT_THAT(segment_bounds(gear5(), late),
              ElementsAre(0.0, ::testing::DoubleNear(0.26, 1e-12), DoubleEq(0.8), 1.0));
}

TEST(SegmentBounds, BreakPhasesThatCoincideAreOne) {
  ModelSetting setting = with_contact_ratio(1.6);
  set_parameter(&setting, "approach", 0.375);  // pitch point at 0.6, where the pair leaves
  EXPECT_THAT(segment_bounds(gear5(), setting), ElementsAre(0.0, DoubleEq(0.6), 1.0));
  set_parameter(&setting, "approach", 1.0 / 1.6);  // pitch point at 1, where a pair enters
  EXPECT_THAT(segment_bounds(gear5(), setting), ElementsAre(0.0, DoubleEq(0.6), 1.0));
}

class Grids : public ::testing::TestWithParam<double> {};

TEST_P(Grids, StepsEndOnTheBreakPhases) {
  const ModelSetting setting = with_contact_ratio(GetParam());
  const std::vector<double> bounds = segment_bounds(gear5(), setting);
  for (const std::size_t wanted : {8U, 31U, 256U, 1000U}) {
    const PhaseGrid grid = make_phase_grid(gear5(), setting, wanted);
    ASSERT_EQ(grid.segment_steps.size(), bounds.size() - 1);
    ASSERT_EQ(grid.segment_fractions.size(), bounds.size() - 1);
    double phase = 0.0;
    std::size_t steps = 0;
    for (std::size_t i = 0; i < grid.segment_steps.size(); ++i) {
      EXPECT_LE(grid.segment_fractions[i], 1.0 / static_cast<double>(wanted) * (1.0 + 1e-6));
      phase += grid.segment_fractions[i] * grid.segment_steps[i];
      EXPECT_NEAR(phase, bounds[i + 1], 1e-15);
      steps += grid.segment_steps[i];
    }
    EXPECT_EQ(steps, grid.steps);
    EXPECT_LT(grid.steps, wanted + grid.segment_steps.size());  // each rounded up
    const std::size_t rows = 2 * grid.steps + grid.segment_steps.size();
    EXPECT_EQ(grid.coefs.size(), rows * gear5().phase_coefs.size());
  }
}

// Rows lie at the ends and middles of the steps; an error that is sin(4 pi psi) tells its phase.
TEST_P(Grids, RowsLieAtEndsAndMiddles) {
  ModelSetting setting = with_contact_ratio(GetParam());
  set_option(&setting, "error", "series");
  set_parameter(&setting, "e0_2", 1.0);
  const PhaseGrid grid = make_phase_grid(gear5(), setting, 100);
  std::size_t row = 0;
  double from = 0.0;
  for (std::size_t i = 0; i < grid.segment_steps.size(); ++i) {
    for (std::size_t half = 0; half <= 2 * grid.segment_steps[i]; ++half) {
      const double psi = from + 0.5 * static_cast<double>(half) * grid.segment_fractions[i];
      EXPECT_NEAR(mesh_in(grid, setting, row++).error, std::sin(4.0 * std::numbers::pi * psi),
                  1e-12);
    }
    from += grid.segment_fractions[i] * grid.segment_steps[i];
  }
}

INSTANTIATE_TEST_SUITE_P(ContactRatios, Grids, ::testing::Values(1.001, 1.3, 1.5, 1.718, 1.999),
                         [](const auto& eps) {
                           return std::to_string(std::lround(1000.0 * eps.param));
                         });

// At a break phase each of the two segments has the value of its own side.
TEST(PhaseGrid, CoefficientsAreOneSidedAtBreakPhases) {
  ModelSetting setting = with_contact_ratio(1.718);
  set_option(&setting, "stiffness", "rectangular");
  const PhaseGrid grid = make_phase_grid(gear5(), setting, 64);
  const std::size_t first_end = 2 * grid.segment_steps[0];
  const std::size_t second_end = first_end + 1 + 2 * grid.segment_steps[1];
  const std::size_t last = second_end + 1 + 2 * grid.segment_steps[2];
  // Two pairs, each of stiffness 1/eps, up to eps - 1; then one.
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, 0).stiffness, 2.0 / 1.718);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, first_end).stiffness, 2.0 / 1.718);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, first_end + 1).stiffness, 1.0 / 1.718);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, last).stiffness, 1.0 / 1.718);
  // Pair 1 approaches up to eps/2, then recedes; pair 2 recedes.
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, first_end).slide_damping, 0.0);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, first_end + 1).slide_damping, 1.0);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, second_end).slide_damping, 1.0);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, second_end + 1).slide_damping, -1.0);
  EXPECT_DOUBLE_EQ(mesh_in(grid, setting, last).slide_damping, -1.0);
}

TEST(Ladder, HasFourRungsPerOctave) {
  const std::vector<std::size_t> rungs = {16, 20, 24, 28, 32, 40, 48, 56, 64, 80};
  for (std::size_t i = 0; i + 1 < rungs.size(); ++i) {
    EXPECT_EQ(ladder_steps(static_cast<double>(rungs[i])), rungs[i]);
    EXPECT_EQ(ladder_steps(static_cast<double>(rungs[i]) + 0.01), rungs[i + 1]);
  }
  EXPECT_EQ(ladder_steps(0.0), 16U);
  EXPECT_EQ(ladder_steps(65535.0), 65536U);
}

TEST(Ladder, WastesLessThanAQuarter) {
  for (double wanted = 16.0; wanted < 70000.0; wanted *= 1.01) {
    const auto steps = static_cast<double>(ladder_steps(wanted));
    EXPECT_GE(steps, wanted);
    EXPECT_LT(steps, 1.25 * wanted + 1e-9);
  }
}

}  // namespace
}  // namespace gearsweep::testing
