// The processes of an MPI launcher share a study: the same maps as from one, also after a rank was
// killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paused_run.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// 32 tiles; each point starts from its neighbour's end when `policy` says so.
const std::string kClusterStudy = coarse_study(16, 32, R"([integrate]
settle = 100
record = 20
tile = 16
[observe]
quantities = ["x1_rms", "period"]
)");

class ClusterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::string(GEARSWEEP_HAS_MPI).starts_with("1")) GTEST_SKIP() << "built without MPI";
    if (run_in(folder_, "sh -c 'command -v mpirun'").status != 0) GTEST_SKIP() << "no mpirun";
    folder_.write("study.toml", kClusterStudy);
  }

  // The words of a shell. before: words that stand before the program.
  static std::string launch(int ranks, const std::string& arguments,
                            const std::string& before = "") {
    return "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe "
           "-n " +
           std::to_string(ranks) + " " + before + GEARSWEEP_BINARY + " run study.toml " + arguments;
  }

  // Empty when all that the two results hold is the same to the bit.
  std::string difference(const std::string& one, const std::string& other) {
    return difference_of_results(folder_ / one, folder_ / other);
  }

  Folder folder_;
};

TEST_F(ClusterTest, AnyNumberOfRanksGivesTheMapsOfOneProcess) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  for (const int ranks : {1, 2, 4}) {
    const Outcome outcome = run_in(folder_, launch(ranks, "-o out.nc"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(std::to_string(ranks) + " processes"));
    EXPECT_EQ(difference("out.nc", "whole.nc"), "") << ranks << " ranks";
  }
}

// What a pilot run has found is not in the study's text: all ranks take these steps.
TEST_F(ClusterTest, AllRanksTakeTheStepsThatAPilotRunHasFound) {
  const std::string found =
      " --set integrate.tolerance=1e-3 --set 'observe.quantities=[\"x1_rms\",\"lyapunov_max\"]' "
      // So long that no rank is done before the others have begun.
      "--set integrate.settle=300 --set integrate.record=1000 --set integrate.tile=4";
  const Outcome whole = gearsweep(folder_, "run study.toml -o whole.nc" + found);
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_THAT(whole.out + whole.err, HasSubstr("1/4 of that on orbits"));
  const Outcome shared = run_in(folder_, launch(3, "-o out.nc" + found));
  EXPECT_EQ(shared.status, 0) << shared.err;
  EXPECT_EQ(difference("out.nc", "whole.nc"), "");
}

TEST_F(ClusterTest, AChainPassesItsStatesOn) {
  const std::string chained = " --set initial.policy=forward --set initial.along=omega --quiet";
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc" + chained).status, 0);
  EXPECT_EQ(run_in(folder_, launch(3, "-o out.nc" + chained)).status, 0);
  EXPECT_EQ(difference("out.nc", "whole.nc"), "");
}

TEST_F(ClusterTest, ARankThatIsKilledEndsTheRunAndTheSameCommandContinues) {
  const long writes = count_writes(folder_, "run study.toml -o whole.nc --quiet", ".journal");
  // Rank 0 pauses with half of the tiles in its journal. The youngest of the processes is not rank
  // 0, which is started first.
  folder_.write(
      "kill.sh",
      launch(1, "-o out.nc --quiet", "env " + paused_in(".journal", writes / 2, "paused")) +
          " : -n 1 " GEARSWEEP_BINARY " run study.toml -o out.nc --quiet & pid=$!\n" +
          wait_for("paused") +
          "\nkill -KILL $(pgrep -P $pid gearsweep | tail -n 1)\nwait $pid; status=$?; rm paused; "
          "exit $status\n");
  const Outcome killed = run_in(folder_, "sh kill.sh");
  EXPECT_NE(killed.status, 0);
  EXPECT_EQ(folder_.files().count("out.nc.journal"), 1U) << killed.err;
  EXPECT_EQ(folder_.files().count("out.nc"), 0U);
  ASSERT_EQ(run_in(folder_, launch(2, "-o out.nc --quiet")).status, 0);
  EXPECT_EQ(difference("out.nc", "whole.nc"), "");
}

TEST_F(ClusterTest, ARankWhoseDeviceFailsHandsItsTilesBackAndTheOthersGoOn) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  for (const char* const after : {"0", "2"}) {
    // The other one waits with its first launch until then, and leaves something to do.
    const Outcome outcome = run_in(
        folder_, launch(1, "-o out.nc", "env LD_PRELOAD=" FAILING_OPENCL " AWAITED_FILE=failed ") +
                     " : -n 1 env LD_PRELOAD=" FAILING_OPENCL
                     " FAILING_CALL=launch FAILED_FILE=failed FAILING_AFTER=" +
                     after + " " + GEARSWEEP_BINARY + " run study.toml -o out.nc");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("CL_OUT_OF_RESOURCES"));
    EXPECT_EQ(difference("out.nc", "whole.nc"), "") << after;
    folder_.remove("failed");
  }
}

TEST_F(ClusterTest, ARankWithoutADeviceIsToldOfAndTheOthersGoOn) {
  const Outcome outcome =
      run_in(folder_, launch(1, "-o out.nc") + " : -n 1 env OCL_ICD_VENDORS=/nowhere " +
                          GEARSWEEP_BINARY + " run study.toml -o out.nc");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("rank 1: no OpenCL device"));
  EXPECT_EQ(folder_.files().count("out.nc"), 1U);
}

TEST_F(ClusterTest, WhenRank0CannotStoreATileTheRunEndsForAll) {
  const std::string samples =
      " --set 'observe.poincare=[\"x1\",\"x2\",\"x3\",\"x4\",\"x5\",\"v1\"]' --set "
      "observe.quantities=['\"poincare\"'] --set integrate.record=400";
  folder_.write("run.sh", std::string("ulimit -f 8000; exec ") + GEARSWEEP_BINARY +
                              " run study.toml -o out.nc --quiet" + samples + "\n");
  // Shared memory is files, too.
  const Outcome full = run_in(folder_,
                              "timeout 600 env OMPI_ALLOW_RUN_AS_ROOT=1 "
                              "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --mca btl "
                              "self,tcp -n 3 sh run.sh");
  EXPECT_EQ(full.status, 1) << full.err;
  EXPECT_THAT(full.err, HasSubstr("'out.nc.journal'"));
  EXPECT_EQ(folder_.files().count("out.nc.journal"), 1U);
  ASSERT_EQ(run_in(folder_, launch(3, "-o out.nc --quiet" + samples)).status, 0);
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet" + samples).status, 0);
  EXPECT_EQ(difference("out.nc", "whole.nc"), "");
}

TEST_F(ClusterTest, ProcessesWithDifferentArgumentsAreRefused) {
  const Outcome outcome = run_in(folder_, "sh -c '" + launch(1, "-o a.nc") + " : -n 1 " +
                                              GEARSWEEP_BINARY + " run study.toml -o b.nc'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("different arguments"));
}

TEST_F(ClusterTest, AWrongStudyIsRefusedOnceAndNobodyHangs) {
  folder_.write("study.toml", "[model]\nname = \"gear6\"\n");
  const Outcome outcome = run_in(folder_, launch(3, "-o out.nc"));
  EXPECT_EQ(outcome.status, 2);
  const std::size_t first = outcome.err.find("gear6");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(outcome.err.find("gear6", first + 1), std::string::npos);
}

}  // namespace
}  // namespace gearsweep::testing
