// An interrupted run keeps what is finished, says how to go on, and the same command continues.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paused_run.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// 64 tiles.
const std::string kInterruptStudy = coarse_study(32, 32, R"([integrate]
settle = 60
record = 20
tile = 16
[observe]
quantities = ["x1_rms", "contact_class"]
)");

class InterruptTest : public ::testing::Test {
 protected:
  // A run that is given nothing else to do writes so often to its journal.
  void SetUp() override {
    folder_.write("study.toml", kInterruptStudy);
    writes_ = count_writes(folder_, "run study.toml -o whole.nc --quiet", ".journal");
    ASSERT_GT(writes_, 100);
  }

  // What a run says and returns that gets the signal in the middle of a write, with a third of its
  // tiles in the journal.
  Outcome interrupt(int signal_number, const std::string& options = "") {
    PausedRun run(folder_, "run study.toml -o out.nc" + options, ".journal", writes_ / 3);
    EXPECT_TRUE(run.is_paused()) << run.said();
    run.send(signal_number);
    if (signal_number != SIGKILL) run.wait_for_words("finishing the running round");
    run.go_on();
    const int status = run.end();
    return {status, "", run.said()};
  }

  std::string difference() const {
    return difference_of_results(folder_ / "out.nc", folder_ / "whole.nc");
  }

  Folder folder_;
  long writes_ = 0;
};

TEST_F(InterruptTest, ASignalEndsTheRunWith130AndTheSameCommandContinues) {
  for (const int signal_number : {SIGTERM, SIGINT}) {
    const Outcome outcome = interrupt(signal_number);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("same command continues"));
    EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc.journal", "study.toml", "whole.nc"}));
  }
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc", "study.toml", "whole.nc"}));
  EXPECT_EQ(difference(), "");
}

TEST_F(InterruptTest, ASignalIsHeardWhateverThreadsADriverHasStarted) {
  const Outcome outcome = interrupt(SIGTERM, " --device 0");
  EXPECT_EQ(outcome.status, 130) << outcome.err;
}

TEST_F(InterruptTest, AKilledRunContinuesToTheSameMaps) {
  EXPECT_EQ(interrupt(SIGKILL).status, 128 + SIGKILL);
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
  EXPECT_EQ(difference(), "");
}

TEST_F(InterruptTest, AnotherStudyDoesNotContinueTheJournal) {
  interrupt(SIGTERM);
  const Outcome outcome = gearsweep(folder_, "run study.toml -o out.nc --set parameters.mu=0.1");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("out.nc.journal"));
  EXPECT_EQ(gearsweep(folder_,
                      "run study.toml -o out.nc --quiet --restart --set "
                      "parameters.mu=0.1 --set integrate.settle=1")
                .status,
            0);
}

}  // namespace
}  // namespace gearsweep::testing
