// Shards that know nothing of each other give, merged, the maps of one run.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support/process.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// 10 tiles of each point's own and of an ensemble's trajectories.
const std::string kShardStudy = coarse_study(10, 16, R"([initial]
ensemble = 2
[integrate]
settle = 60
record = 16
tile = 32
[observe]
quantities = ["x1_rms", "period", "attractor_count"]
poincare = ["x1"]
)");

class ShardTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kShardStudy); }

  Outcome run(const std::string& options) {
    return gearsweep(folder_, "run study.toml -o map.nc --quiet " + options);
  }
  Outcome merge(const std::string& journals) {
    return gearsweep(folder_, "merge " + journals + " -o merged.nc --quiet");
  }
  // Empty when all that the two results hold is the same to the bit.
  std::string difference(const std::string& one, const std::string& other) {
    return difference_of_results(folder_ / one, folder_ / other);
  }

  Folder folder_;
};

TEST_F(ShardTest, MergedTheyAreTheMapsOfOneRun) {
  ASSERT_EQ(run("").status, 0);
  for (const char* shard : {"2/3", "3/3", "1/3"}) {
    ASSERT_EQ(run(std::string("--shard ") + shard).status, 0) << shard;
  }
  const Outcome merged = merge("map.nc.shard-*.journal");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(difference("merged.nc", "map.nc"), "");
}

TEST_F(ShardTest, StatusTellsWhichAreThere) {
  ASSERT_EQ(run("--shard 1/2").status, 0);
  const Outcome one = gearsweep(folder_, "status map.nc");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("map.nc, in 2 shards; computed: 1\n"));
  EXPECT_THAT(one.out, Not(HasSubstr("merge")));
  ASSERT_EQ(run("--shard 2/2").status, 0);
  EXPECT_THAT(gearsweep(folder_, "status map.nc").out,
              HasSubstr("computed: 1, 2\nto put them together: gearsweep merge "));
  const Outcome json = gearsweep(folder_, "status map.nc --json");
  EXPECT_THAT(json.out, HasSubstr("\"shard\": \"2/2\""));
}

// Its step is still being found: the journal is empty.
TEST_F(ShardTest, StatusKnowsAShardThatHasJustBegun) {
  folder_.write("map.nc.shard-2-of-3.journal", "");
  folder_.write("map.nc.shard-of-mine.journal", "");
  const Outcome begun = gearsweep(folder_, "status map.nc");
  EXPECT_EQ(begun.status, 0) << begun.err;
  EXPECT_THAT(begun.out, HasSubstr("map.nc, in 3 shards; interrupted: 2\n"));
  EXPECT_THAT(begun.out, Not(HasSubstr("merge")));
}

// What a node does with the script: each job of the array, then the line that merges.
TEST_F(ShardTest, TheScriptOfAJobArrayGivesTheMapsOfOneRun) {
  ASSERT_EQ(run("").status, 0);
  const Outcome script = gearsweep(folder_, "slurm study.toml --jobs 3 -o jobs.nc");
  ASSERT_EQ(script.status, 0) << script.err;
  EXPECT_THAT(script.out, HasSubstr("#SBATCH --array=1-3\n"));
  folder_.write("job.sh", script.out);
  const std::string path = std::filesystem::path(GEARSWEEP_BINARY).parent_path().string();
  for (const char* job : {"2", "1", "3"}) {
    const std::string line =
        fmt::format("PATH='{}':$PATH SLURM_ARRAY_TASK_ID={} bash job.sh", path, job);
    ASSERT_EQ(run_in(folder_, line).status, 0) << job;
  }
  const Outcome merged = gearsweep(folder_, "merge jobs.nc.shard-*.journal -o merged.nc --quiet");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(difference("merged.nc", "map.nc"), "");
}

TEST_F(ShardTest, AJobArrayNeedsAnythingToShare) {
  EXPECT_THAT(gearsweep(folder_, "slurm study.toml --jobs 321").err,
              HasSubstr("has 320 trajectories; give at most so many"));
  EXPECT_THAT(gearsweep(folder_, "slurm study.toml --jobs 2 -o 'a\nb.nc'").err,
              HasSubstr("control characters"));
  EXPECT_THAT(gearsweep(folder_, "slurm study.toml --jobs 2 --time soon").err,
              HasSubstr("'soon' is no time"));
}

// The draws of a point lie in tiles of all three, and Sobol indices take every one of them.
TEST_F(ShardTest, DrawsOfUncertainParametersComeTogether) {
  folder_.write("study.toml", kTolerantStudy);
  ASSERT_EQ(run("").status, 0);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    ASSERT_EQ(run(std::string("--shard ") + shard).status, 0) << shard;
  }
  const Outcome merged = merge("map.nc.shard-*.journal");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(difference("merged.nc", "map.nc"), "");
}

TEST_F(ShardTest, AMissingOrForeignShardIsNamed) {
  ASSERT_EQ(run("--shard 1/3").status, 0);
  ASSERT_EQ(run("--shard 2/3").status, 0);
  EXPECT_THAT(merge("map.nc.shard-*.journal").err, HasSubstr("no journal of number 3"));
  ASSERT_EQ(run("--shard 3/3 --set integrate.settle=70").status, 0);
  const Outcome foreign = merge("map.nc.shard-*.journal");
  EXPECT_EQ(foreign.status, 2);
  EXPECT_THAT(foreign.err, HasSubstr("shard-3-of-3"));
  EXPECT_THAT(foreign.err, HasSubstr("settle = 70"));
  EXPECT_THAT(merge("map.nc.shard-1* map.nc.shard-1*").err, HasSubstr("both shard 1 of 3"));
  EXPECT_EQ(folder_.files().count("merged.nc"), 0U);
}

TEST_F(ShardTest, TheCutDoesNotDependOnTheDevice) {
  const std::string uncut = " --set integrate.tile=0";
  ASSERT_EQ(run("--shard 1/2 --device 0" + uncut).status, 0);
  ASSERT_EQ(run("--shard 2/2 --device 0/2" + uncut).status, 0);
  EXPECT_EQ(merge("map.nc.shard-*.journal").status, 0);
}

TEST_F(ShardTest, AShardWithoutTilesIsDone) {
  ASSERT_EQ(run("--shard 20/20").status, 0);
  EXPECT_THAT(gearsweep(folder_, "status map.nc.shard-20-of-20.journal").out,
              HasSubstr("computed, 100.0 % done: 0 of 0 points"));
}

TEST_F(ShardTest, AChainIsRefused) {
  const std::string chain =
      "--set initial.policy=forward --set initial.along=omega --set initial.ensemble=1 "
      "--set 'observe.quantities=[\"x1_rms\"]'";
  const Outcome outcome = run("--shard 1/2 " + chain);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--shard"));
  EXPECT_THAT(outcome.err, HasSubstr("mpirun"));
  const Outcome script = gearsweep(folder_, "slurm study.toml --jobs 2 " + chain);
  EXPECT_EQ(script.status, 2);
  EXPECT_EQ(script.out, "");
  EXPECT_THAT(script.err, HasSubstr("start where their neighbours end"));
}

TEST_F(ShardTest, WhatIsNoShardIsRefused) {
  for (const char* text :
       {"3/2", "0/2", "1", "1/2/3", "a/b", "-1/2", "1/-1", "1/1152921504606846976"}) {
    const Outcome outcome = run(std::string("--shard=") + text);
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr("K/N")) << text;
  }
}

}  // namespace
}  // namespace gearsweep::testing
