// kill -9 in the middle of any write leaves no result or a whole one, and the same command goes on
// to the result of an unbroken run. GEARSWEEP_KILLS says how often to kill.
#include <gtest/gtest.h>

#include <random>

#include "support/paused_run.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// 16 tiles of every kind of launch, then a result of 6.5 MB before compression.
const std::string kKillStudy = coarse_study(32, 32, R"([integrate]
settle = 80
record = 200
extend = 1
tile = 64
[observe]
quantities = ["x1_rms", "dmf_max", "contact_class", "period", "lyapunov_max", "poincare"]
poincare = ["x1", "v1", "x2", "v2"]
)");

int chosen_kills() {
  const char* chosen = std::getenv("GEARSWEEP_KILLS");
  return chosen == nullptr ? 6 : std::atoi(chosen);
}

class KillTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kKillStudy); }

  long writes_to(const std::string& ending) const {
    return count_writes(folder_, "run study.toml -o whole.nc --quiet", ending);
  }

  // In a write to a file of this ending, somewhere in the given share of all writes to such.
  void kill_in(const std::string& ending, long writes, double share) {
    std::uniform_int_distribution<long> at(
        1, std::max(1L, static_cast<long>(share * static_cast<double>(writes))));
    const long chosen = at(random_);
    SCOPED_TRACE("write " + std::to_string(chosen) + " to *" + ending);
    PausedRun run(folder_, "run study.toml -o out.nc --quiet", ending, chosen);
    EXPECT_TRUE(run.is_paused()) << run.said();
    run.send(SIGKILL);
    EXPECT_EQ(run.end(), 128 + SIGKILL);
    if (!std::filesystem::exists(folder_ / "out.nc")) return;
    EXPECT_EQ(difference_of_results(folder_ / "out.nc", folder_ / "whole.nc"), "");
  }

  Folder folder_;
  std::mt19937 random_{1};
};

TEST_F(KillTest, AKilledRunLeavesNoResultOrAWholeOneAndContinuesToTheSameBits) {
  // SQLite's own record of what it is about to change, the journal, the result.
  const long intents = writes_to("-journal");
  const long tiles = writes_to(".journal");
  const long parts = writes_to(".part");
  ASSERT_GT(std::min({intents, tiles, parts}), 10);
  for (int killed = 0; killed < chosen_kills(); killed += 3) {
    // The first two leave enough to do that the next comes to its write.
    kill_in("-journal", intents, 0.4);
    kill_in(".journal", tiles, 0.4);
    kill_in(".part", parts, 1.0);
    EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
    EXPECT_EQ(difference_of_results(folder_ / "out.nc", folder_ / "whole.nc"), "");
    EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc", "study.toml", "whole.nc"}));
    std::filesystem::remove(folder_ / "out.nc");
  }
}

}  // namespace
}  // namespace gearsweep::testing
