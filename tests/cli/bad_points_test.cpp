// Points that fail are counted, and are an error only when all of them do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "result/result_file.hpp"
#include "support/process.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Steps of 0.05 are far too long for the stiffer bearing, which drives no gear.
const char* const kBadPointsStudy = R"([model]
preset = "coarse"
[[axes]]
name = "k1"
values = [1.0, 1.38, 1e6]
[integrate]
settle = 20
record = 10
states = "all"
[observe]
quantities = ["x1_rms"]
)";

TEST(BadPointsOfARun, AreCountedAndHaveAStatusInTheFile) {
  const Folder folder;
  folder.write("study.toml", kBadPointsStudy);
  const Outcome outcome = gearsweep(folder, "run study.toml -o out.nc");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("3 points: ok 2, diverged 1"));
  const ResultMap status = ResultFile((folder / "out.nc").string()).read("status");
  EXPECT_THAT(status.values, ElementsAre(STATUS_ok, STATUS_ok, STATUS_diverged));
}

TEST(BadPointsOfARun, AreAnErrorWhenThereAreNoOthers) {
  const Folder folder;
  folder.write("study.toml", kBadPointsStudy);
  const Outcome outcome =
      gearsweep(folder, "run study.toml -o out.nc --set 'axes.k1.values=[1e5, 1e6]'");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("every point failed; the maps are empty"));
  EXPECT_EQ(folder.files(), (std::set<std::string>{"out.nc", "study.toml"}));
}

}  // namespace
}  // namespace gearsweep::testing
