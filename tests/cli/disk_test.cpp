// A disk that is full or closed: the run says so, keeps what is finished, and goes on when there is
// room.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paused_run.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// 16 tiles of 0.8 MB each in the journal, in all 13.2 MB; a result of 5 MB. No limit here is so low
// that a driver could not keep its compiled kernels.
const std::string kDiskStudy = coarse_study(32, 32, R"([integrate]
settle = 300
record = 400
stop = "never"
tile = 64
[observe]
quantities = ["x1_rms", "poincare"]
poincare = ["x1", "v1", "x2", "v2"]
)");

class DiskTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("study.toml", kDiskStudy);
    ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  }

  // With a file system in memory at `disk`, which is gone afterwards; nothing where that is not
  // allowed.
  std::optional<Outcome> run_with_disk(const std::string& options, const std::string& commands) {
    std::filesystem::create_directory(folder_ / "disk");
    const std::string mount = "mount -t tmpfs -o " + options + " tmpfs disk || exit 99\n";
    folder_.write("commands.sh", mount + "run() { " + GEARSWEEP_BINARY +
                                     " run study.toml --quiet \"$@\"; }\n" + commands);
    Outcome outcome = run_in(folder_, "unshare --map-root-user --mount sh commands.sh");
    if (outcome.status == 99 || has_failed(outcome, "unshare")) return std::nullopt;
    return outcome;
  }

  static bool has_failed(const Outcome& outcome, const std::string& program) {
    return outcome.status != 0 && outcome.err.find(program + ": ") != std::string::npos;
  }

  std::string difference() const {
    return difference_of_results(folder_ / "out.nc", folder_ / "whole.nc");
  }

  Folder folder_;
};

TEST_F(DiskTest, ADiskThatFillsUpWhileTilesAreJournaledKeepsTheFinishedOnes) {
  // Something else takes the room that was there when the run began.
  const std::optional<Outcome> outcome = run_with_disk(
      "size=40m", "env " + paused_in(".journal", 1, "paused") + GEARSWEEP_BINARY +
                      " run study.toml --quiet -o disk/out.nc & pid=$!\n" + wait_for("paused") +
                      "head -c 36M /dev/zero > disk/other; rm paused\n"
                      "wait $pid; echo status $?\n"
                      "ls disk\n"
                      "rm disk/other\n"
                      "run -o disk/out.nc; echo status $?\n"
                      "ls disk; cp disk/out.nc out.nc\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 1\nother\nout.nc.journal\nstatus 0\nout.nc\n") << outcome->err;
  EXPECT_THAT(outcome->err, HasSubstr("disk/out.nc.journal': database or disk is full"));
  EXPECT_EQ(difference(), "");
}

TEST_F(DiskTest, ADiskWithoutRoomForTheResultKeepsTheJournal) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet --keep-journal").status, 0);
  const std::optional<Outcome> outcome = run_with_disk("size=40m",
                                                       "cp out.nc.journal disk\n"
                                                       "mount -o remount,size=14500k disk\n"
                                                       "run -o disk/out.nc; echo status $?\n"
                                                       "ls disk\n"
                                                       "mount -o remount,size=40m disk\n"
                                                       "run -o disk/out.nc; echo status $?\n"
                                                       "ls disk; cp disk/out.nc out.nc\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 1\nout.nc.journal\nstatus 0\nout.nc\n") << outcome->err;
  EXPECT_THAT(outcome->err, HasSubstr("'disk/out.nc'"));
  EXPECT_THAT(outcome->err, HasSubstr("No space left on device"));
  EXPECT_EQ(difference(), "");
}

TEST_F(DiskTest, ATraceWithoutRoomSaysSo) {
  const std::string trace = GEARSWEEP_BINARY " trace study.toml --at omega=0.7,e0=0.5 --quiet -o ";
  const std::optional<Outcome> outcome = run_with_disk(
      "size=1m", "cat /dev/zero > disk/other\n" + trace + "disk/out.nc; echo status $?\n" + trace +
                     "disk/out.csv; echo status $?\n" + "ls disk\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 1\nstatus 1\nother\n");
  EXPECT_THAT(outcome->err, HasSubstr("in 'disk/out.nc': No space left on device"));
  EXPECT_THAT(outcome->err, HasSubstr("'disk/out.csv': No space left on device"));
}

TEST_F(DiskTest, APictureForLatexWithoutRoomSaysSo) {
  const std::optional<Outcome> outcome = run_with_disk(
      "size=1m", "cat /dev/zero > disk/other\n" GEARSWEEP_BINARY
                 " plot whole.nc -q x1_rms -o disk/map.tex; echo status $?\nls disk\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 1\nother\n");
  EXPECT_THAT(outcome->err, HasSubstr("gnuplot wrote no whole picture for 'disk/map.pdf'; is the "
                                      "disk full?"));
}

TEST_F(DiskTest, AFileThatMayNotGrowIsAnErrorLikeAFullDisk) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet --keep-journal").status, 0);
  std::filesystem::remove(folder_ / "out.nc");
  const Outcome writing = run_in(folder_, "sh -c 'ulimit -f 5000; exec " GEARSWEEP_BINARY
                                          " run study.toml -o out.nc --quiet'");
  EXPECT_EQ(writing.status, 1);
  EXPECT_THAT(writing.err, HasSubstr("'out.nc'"));
  EXPECT_THAT(writing.err, HasSubstr("File too large"));
  EXPECT_EQ(folder_.files().count("out.nc.journal"), 1U);
  EXPECT_EQ(folder_.files().count("out.nc"), 0U);
  const Outcome journaling = run_in(folder_, "sh -c 'ulimit -f 12000; exec " GEARSWEEP_BINARY
                                             " run study.toml -o new.nc --quiet'");
  EXPECT_EQ(journaling.status, 1);
  EXPECT_THAT(journaling.err, HasSubstr("'new.nc.journal'"));
  for (const std::string output : {"out.nc", "new.nc"}) {
    ASSERT_EQ(gearsweep(folder_, "run study.toml --quiet -o " + output).status, 0);
    EXPECT_EQ(difference_of_results(folder_ / output, folder_ / "whole.nc"), "");
  }
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"new.nc", "out.nc", "study.toml", "whole.nc"}));
}

TEST_F(DiskTest, ADiskThatIsTooSmallIsRefusedBeforeAnythingIsWritten) {
  const std::optional<Outcome> outcome = run_with_disk("size=1m",
                                                       "run -o disk/out.nc; echo status $?\n"
                                                       "run --dry-run -o disk/out.nc; echo status "
                                                       "$?\n"
                                                       "ls disk\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 2\nstatus 2\n") << outcome->err;
  EXPECT_THAT(outcome->err, HasSubstr("and 'disk' has 1.0 MB; make room there"));
}

TEST_F(DiskTest, AFolderThatCannotBeWrittenToIsRefusedAtOnce) {
  const std::optional<Outcome> outcome =
      run_with_disk("size=40m,ro", "run -o disk/out.nc; echo status $?\nls disk\n");
  if (!outcome) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(outcome->out, "status 2\n");
  EXPECT_THAT(outcome->err, HasSubstr("cannot write 'disk/out.nc': Read-only file system"));
}

}  // namespace
}  // namespace gearsweep::testing
