// An interrupted run keeps what is finished, says how to go on, and the same command continues.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// Small tiles and rounds, so that a signal comes between them; far too long to finish before it.
const char* const kLong = R"([model]
preset = "coarse"
[[axes]]
name = "omega"
from = 0.5
to = 1.5
count = 64
[[axes]]
name = "e0"
from = 0.1
to = 0.7
count = 64
[integrate]
settle = 1200
record = 20
tile = 64
[observe]
quantities = ["x1_rms", "contact_class"]
)";

class InterruptTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kLong); }

  // Starts the run, waits until its journal holds some more of the 64 tiles (each about 10 kB), and
  // sends it a signal.
  Outcome interrupt(const std::string& signal, const std::string& options = "") {
    return run_in(folder_,
                  "sh -c 'size() { stat -c %s out.nc.journal 2>/dev/null || echo 0; }; "
                  "enough=$(($(size) + 100000)); " +
                      std::string(GEARSWEEP_BINARY) + " run study.toml -o out.nc" + options +
                      " & pid=$!; "
                      "while kill -0 $pid && [ $(size) -lt $enough ]; do sleep 0.02; "
                      "done; kill -" +
                      signal + " $pid; wait $pid'");
  }

  std::string exported(const std::string& result) {
    gearsweep(folder_, "export " + result + " -q x1_rms -o " + result + ".csv");
    return read_all(folder_ / (result + ".csv"));
  }

  Folder folder_;
};

TEST_F(InterruptTest, ASignalEndsTheRunWith130AndTheSameCommandContinues) {
  for (const char* signal : {"TERM", "INT"}) {
    const Outcome outcome = interrupt(signal);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("same command continues"));
    EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc.journal", "study.toml"}));
  }
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc", "study.toml"}));
}

TEST_F(InterruptTest, ASignalIsHeardWhateverThreadsADriverHasStarted) {
  const Outcome outcome = interrupt("TERM", " --device 0");
  EXPECT_EQ(outcome.status, 130) << outcome.err;
}

TEST_F(InterruptTest, AKilledRunContinuesToTheSameMaps) {
  EXPECT_NE(interrupt("KILL").status, 0);
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  EXPECT_EQ(exported("out.nc"), exported("whole.nc"));
}

TEST_F(InterruptTest, AnotherStudyDoesNotContinueTheJournal) {
  interrupt("TERM");
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
