// The published steady motions, from the kernel in fp64 and fp32 and from the reference engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/print_rows.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

void expect_row(const SweepResult& result, const ReferenceRow& row) {
  ASSERT_EQ(result.status[0], 0);
  for (const Compared& compared : compare_row(row, result)) {
    EXPECT_TRUE(compared.holds()) << describe(compared);
  }
}

class ReferenceNumbers : public ::testing::TestWithParam<ReferenceRow> {};

// With the kernels of other tests, which sample all states.
SweepResult on_device(const ReferenceRow& row) {
  const std::string study = study_of(row, converged_steps(row));
  return run(study.substr(0, study.find("[observe]")) + kObserveGear5);
}

TEST_P(ReferenceNumbers, KernelInFp64) {
  const ReferenceRow& row = GetParam();
  SweepResult result = on_device(row);
  // The second of the samples shall be v1.
  const std::vector<double> v1 = samples_of(result, 0, state_index(gear5(), "v1"));
  std::ranges::copy(v1, result.samples.begin() + static_cast<std::ptrdiff_t>(v1.size()));
  expect_row(result, row);
}

// `paper` forgets a start in thousands of periods. The reference engine begins where the device
// ends: if it knew another motion, it would have gone most of the way there after a thousand.
TEST_P(ReferenceNumbers, ReferenceEngine) {
  const ReferenceRow& row = GetParam();
  std::vector<std::string> start;
  if (row.preset == "paper") {
    const SweepResult settled = on_device(row);
    std::string state;
    for (std::size_t i = 0; i < gear5().states.size(); ++i) {
      state += fmt::format("{} = {}, ", gear5().states[i].name,
                           digits(samples_of(settled, 0, i).back()));
    }
    start = {"initial.policy='fixed'", "initial.state={" + state.substr(0, state.size() - 2) + "}",
             "integrate.settle=1000"};
  }
  expect_row(run(study_of(row, converged_steps(row) + "engine = 'reference'\n"), start), row);
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
