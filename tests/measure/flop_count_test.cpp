#include "measure/flop_count.hpp"

#include <gtest/gtest.h>

#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

Study study_with(const std::string& override) {
  return read_study(R"([model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 0.4
to = 2.0
count = 4
[observe]
quantities = ["x1_max"]
)",
                    "flop_count_test", {override});
}

TEST(FlopCount, GrowsWithTangentsAndWithTheBacklashLaw) {
  const Study constant = study_with("model.backlash=constant");
  const double alone = flops_per_step(constant, 0);
  EXPECT_GT(alone, 100.0);
  const double tangent = flops_per_step(constant, 1) - alone;
  EXPECT_GT(tangent, 0.0);
  // Each tangent vector takes the same work; the first one also asks for the Jacobian.
  EXPECT_LE(flops_per_step(constant, 3) - flops_per_step(constant, 2), tangent);
  EXPECT_GT(flops_per_step(study_with("model.backlash=dynamic"), 0), alone);
}

TEST(FlopCount, LeavesOutTheCorrectionOfSteps) {
  EXPECT_EQ(flops_per_step(study_with("integrate.events=false"), 0),
            flops_per_step(study_with("integrate.events=true"), 0));
}

}  // namespace
}  // namespace gearsweep::testing
