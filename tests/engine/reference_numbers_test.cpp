// The published steady motions, from the kernel in fp64 and fp32 and from the reference engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/reference_rows.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// Steps per period at which the motions are converged, and at which least and greatest of the
// steps' ends are those of the motion (see expect_row). The `paper` rows move slowly, hence fewer
// steps.
std::string steps_for(const ReferenceRow& row) {
  if (row.preset != "paper") return "steps_per_period = 4096\n";
  return row.omega < 0.2 ? "steps_per_period = 1024\n" : "steps_per_period = 512\n";
}

// Distance of the nearest recorded section to the stated one, which for a motion of period 3 is one
// of three.
double section_distance(const SweepResult& result, const ReferenceRow& row) {
  const std::vector<double> x1 = samples_of(result, 0, 0);
  const std::vector<double> v1 = samples_of(result, 0, 1);
  double nearest = std::abs(x1[0] - row.x1) + std::abs(v1[0] - row.v1);
  for (std::size_t i = 0; i < x1.size(); ++i) {
    nearest = std::min(nearest, std::max(std::abs(x1[i] - row.x1), std::abs(v1[i] - row.v1)));
  }
  return nearest;
}

void expect_row(const SweepResult& result, const ReferenceRow& row) {
  ASSERT_EQ(result.status[0], 0);
  const auto value = [&](const char* quantity) { return map_of(result, quantity)[0]; };
  // Half of the seventh decimal that is stated, and 5e-9 for the steps and what is left of the
  // start.
  EXPECT_LE(section_distance(result, row), 5e-8 + 5e-9);
  // Half of the fifth decimal; sampling adds (h/2)^2/2 |x1''|, which is less than 2e-6.
  EXPECT_NEAR(value("x1_min"), row.least, 5e-6);
  EXPECT_NEAR(value("x1_max"), row.greatest, 5e-6);
  // Half of the sixth decimal; the trapezoidal rule adds 1e-8.
  EXPECT_NEAR(value("x1_mean"), row.mean, 5e-7);
  EXPECT_NEAR(value("x1_rms"), row.rms, 5e-7);
  // The table's own tolerance: the force jumps at break phases.
  EXPECT_NEAR(value("dmf_min"), row.dmf_least, 3e-4);
  EXPECT_NEAR(value("dmf_max"), row.dmf_greatest, 3e-4);
}

class ReferenceNumbers : public ::testing::TestWithParam<ReferenceRow> {};

TEST_P(ReferenceNumbers, KernelInFp64) {
  const ReferenceRow& row = GetParam();
  expect_row(run(study_of(row, steps_for(row))), row);
}

TEST_P(ReferenceNumbers, ReferenceEngine) {
  const ReferenceRow& row = GetParam();
  expect_row(run(study_of(row, steps_for(row) + "engine = 'reference'\n")), row);
}

INSTANTIATE_TEST_SUITE_P(AllRows, ReferenceNumbers, ::testing::ValuesIn(reference_rows()),
                         [](const auto& row) { return row.param.name; });

std::vector<ReferenceRow> damped_rows() {
  std::vector<ReferenceRow> rows = reference_rows();
  std::erase_if(rows, [](const ReferenceRow& row) { return row.preset == "paper"; });
  return rows;
}

class ReferenceNumbersFp32 : public ::testing::TestWithParam<ReferenceRow> {};

// fp32 has a unit roundoff of 6e-8, and the damping forgets the rounding of all but some 1e4 steps:
// even if it all added up, that would be 6e-4 of a state of size 1. `paper` forgets too little.
TEST_P(ReferenceNumbersFp32, KernelWithinAThousandth) {
  const ReferenceRow& row = GetParam();
  const SweepResult result = run(study_of(row, "precision = 'fp32'\nsteps_per_period = 512\n"));
  ASSERT_EQ(result.status[0], 0);
  const auto value = [&](const char* quantity) { return map_of(result, quantity)[0]; };
  EXPECT_LE(section_distance(result, row), 1e-3);
  EXPECT_NEAR(value("x1_min"), row.least, 1e-3);
  EXPECT_NEAR(value("x1_max"), row.greatest, 1e-3 * row.greatest);
  EXPECT_NEAR(value("x1_mean"), row.mean, 1e-3 * row.mean);
  EXPECT_NEAR(value("x1_rms"), row.rms, 1e-3 * row.rms);
  EXPECT_NEAR(value("dmf_min"), row.dmf_least, 1e-3);
  EXPECT_NEAR(value("dmf_max"), row.dmf_greatest, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(DampedRows, ReferenceNumbersFp32, ::testing::ValuesIn(damped_rows()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gearsweep::testing
