// The published steady motions, from the kernel in fp64 and fp32 and from the reference engine.
#include <gtest/gtest.h>

#include "support/print_rows.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

void expect_row(const SweepResult& result, const ReferenceRow& row) {
  ASSERT_EQ(result.status[0], 0);
  for (const Compared& compared : compare_row(row, result)) {
    EXPECT_TRUE(compared.holds()) << describe(compared);
  }
}

class ReferenceNumbers : public ::testing::TestWithParam<ReferenceRow> {};

TEST_P(ReferenceNumbers, KernelInFp64) {
  const ReferenceRow& row = GetParam();
  expect_row(run(study_of(row, converged_steps(row))), row);
}

TEST_P(ReferenceNumbers, ReferenceEngine) {
  const ReferenceRow& row = GetParam();
  expect_row(run(study_of(row, converged_steps(row) + "engine = 'reference'\n")), row);
}

INSTANTIATE_TEST_SUITE_P(AllRows, ReferenceNumbers, ::testing::ValuesIn(reference_rows()),
                         [](const auto& row) { return row.param.name; });

std::vector<ReferenceRow> damped_rows() {
  std::vector<ReferenceRow> rows = reference_rows();
  std::erase_if(rows, [](const ReferenceRow& row) { return row.preset == "paper"; });
  return rows;
}

class ReferenceNumbersFp32 : public ::testing::TestWithParam<ReferenceRow> {};

// `paper` forgets too little of the rounding.
TEST_P(ReferenceNumbersFp32, KernelWithinAThousandth) {
  const ReferenceRow& row = GetParam();
  expect_row(run(study_of(row, "precision = 'fp32'\nsteps_per_period = 512\n")), row);
}

INSTANTIATE_TEST_SUITE_P(DampedRows, ReferenceNumbersFp32, ::testing::ValuesIn(damped_rows()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gearsweep::testing
