// Several devices share a study: the same maps as from one, also when one of them fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "journal/detail/database.hpp"
#include "support/paused_run.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// 16 tiles; exponents and early stopping, so that all kernels are at work.
const std::string kDevicesStudy = coarse_study(16, 16, R"([integrate]
settle = 150
record = 20
tile = 16
[observe]
quantities = ["x1_rms", "dmf_max", "period", "lyapunov_max"]
)");

class DevicesTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kDevicesStudy); }

  Outcome run(const std::string& output, const std::string& options,
              const std::string& environment = "") {
    return run_in(folder_, environment + " " + std::string(GEARSWEEP_BINARY) +
                               " run study.toml -o " + output + " " + options);
  }

  Outcome run_with_failure(const std::string& call, int after, const std::string& device) {
    return run("out.nc", "--device " + device,
               std::string("LD_PRELOAD=") + FAILING_OPENCL + " FAILING_CALL=" + call +
                   " FAILING_AFTER=" + std::to_string(after));
  }

  // Empty when all that the two results hold is the same to the bit.
  std::string difference(const std::string& one, const std::string& other) {
    return difference_of_results(folder_ / one, folder_ / other);
  }

  Folder folder_;
};

TEST_F(DevicesTest, PartsOfADeviceGiveTheMapsOfTheWhole) {
  ASSERT_EQ(run("whole.nc", "--quiet").status, 0);
  for (const char* devices : {"0/2", "0,0", "0,0/2"}) {
    ASSERT_EQ(run("out.nc", std::string("--quiet --device ") + devices).status, 0) << devices;
    EXPECT_EQ(difference("out.nc", "whole.nc"), "") << devices;
  }
}

TEST_F(DevicesTest, PartsOfADeviceShareTheDrawsOfAPoint) {
  folder_.write("study.toml", kTolerantStudy);
  ASSERT_EQ(run("whole.nc", "--quiet").status, 0);
  for (const char* devices : {"0/2", "0,0/2"}) {
    ASSERT_EQ(run("out.nc", std::string("--quiet --device ") + devices).status, 0) << devices;
    EXPECT_EQ(difference("out.nc", "whole.nc"), "") << devices;
  }
}

TEST_F(DevicesTest, ADeviceThatFailsHandsItsTileBackAndTheOthersGoOn) {
  ASSERT_EQ(run("whole.nc", "--quiet").status, 0);
  struct Failure {
    const char* call;
    int after;
    const char* words;
  };
  for (const Failure& failure : {Failure{"launch", 30, "CL_OUT_OF_RESOURCES"},
                                 Failure{"allocate", 50, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
                                 Failure{"build", 0, "cannot build the kernels"}}) {
    const Outcome outcome = run_with_failure(failure.call, failure.after, "0/2");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning"));
    EXPECT_THAT(outcome.err, HasSubstr(failure.words));
    EXPECT_EQ(difference("out.nc", "whole.nc"), "") << failure.call;
  }
}

TEST_F(DevicesTest, WhenTheLastDeviceFailsWhatIsFinishedIsKept) {
  ASSERT_EQ(run("whole.nc", "--quiet").status, 0);
  const Outcome outcome = run_with_failure("launch", 150, "0");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("CL_OUT_OF_RESOURCES"));
  EXPECT_EQ(folder_.files().count("out.nc.journal"), 1U);
  const Outcome again = run("out.nc", "");
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("journal"));
  EXPECT_EQ(difference("out.nc", "whole.nc"), "");
}

TEST_F(DevicesTest, AnotherDeviceContinuesUnlessItIsForbidden) {
  // Parts have the name of the whole, and a device of another name is not at hand on every machine;
  // its build options tell one with other lanes.
  ASSERT_EQ(run("whole.nc", "--quiet --keep-journal --strict-device").status, 0);
  EXPECT_EQ(folder_.files().count("whole.nc.journal"), 1U);
  Database((folder_ / "whole.nc.journal").string())
      .execute("UPDATE sweep SET value = value || ' -D OTHER' WHERE name = 'build options'");
  const Outcome strict = run("whole.nc", "--strict-device");
  EXPECT_EQ(strict.status, 2);
  EXPECT_THAT(strict.err, HasSubstr("build options: "));
  EXPECT_THAT(strict.err, HasSubstr("-D OTHER' there"));
  EXPECT_EQ(run("whole.nc", "--quiet --keep-journal").status, 0);
  // Two kinds of device have had it now.
  const Outcome after = run("whole.nc", "--strict-device");
  EXPECT_EQ(after.status, 2);
  EXPECT_THAT(after.err, HasSubstr("-D OTHER; then "));
}

TEST_F(DevicesTest, StatusTellsHowFarARunIs) {
  EXPECT_EQ(gearsweep(folder_, "status out.nc").status, 2);
  ASSERT_EQ(run_with_failure("launch", 150, "0").status, 1);
  const Outcome interrupted = gearsweep(folder_, "status out.nc");
  EXPECT_EQ(interrupted.status, 0);
  EXPECT_THAT(interrupted.out, HasSubstr("out.nc: interrupted"));
  EXPECT_THAT(interrupted.out, HasSubstr("of 256 points"));
  EXPECT_THAT(interrupted.out, HasSubstr("to continue: gearsweep run 'study.toml' -o 'out.nc'"));
  ASSERT_EQ(run("out.nc", "--quiet").status, 0);
  EXPECT_THAT(gearsweep(folder_, "status out.nc").out, HasSubstr("out.nc: finished"));
}

// As it stands there, by a shell: it ends as the interrupted one would have.
TEST_F(DevicesTest, TheCommandOfStatusIsAllOfIt) {
  folder_.write("it's.toml", read_all(folder_ / "study.toml"));
  ASSERT_EQ(gearsweep(folder_,
                      "run \"it's.toml\" -o map.nc --plot map.svg -q x1_rms --device 0 --lanes 2 "
                      "--keep-journal --strict-device --quiet --set parameters.mu=0.1 --zoom "
                      "omega=0.6:0.9")
                .status,
            0);
  std::filesystem::remove(folder_ / "map.svg");
  std::filesystem::remove(folder_ / "map.nc");
  Database((folder_ / "map.nc.journal").string()).execute("DELETE FROM tile WHERE number > 2");
  const std::string status = gearsweep(folder_, "status map.nc").out;
  const std::string mark = "to continue: gearsweep ";
  const std::string command = status.substr(status.find(mark) + mark.size());
  EXPECT_EQ(command,
            "run 'it'\\''s.toml' -o 'map.nc' --device 0 --set 'parameters.mu=0.1' --set "
            "'integrate.lanes=2' --zoom 'omega=0.6:0.9' --plot 'map.svg' -q 'x1_rms' "
            "--strict-device --keep-journal --quiet\n");
  const Outcome continued = gearsweep(folder_, command.substr(0, command.size() - 1));
  EXPECT_EQ(continued.status, 0) << continued.err;
  EXPECT_THAT(read_all(folder_ / "map.svg"), HasSubstr("<svg"));
  EXPECT_EQ(folder_.files().count("map.nc.journal"), 1U);
}

TEST_F(DevicesTest, RestartDoesNotTakeTheJournalOfARunningStudy) {
  const long writes = count_writes(folder_, "run study.toml -o whole.nc --quiet", ".journal");
  PausedRun first(folder_, "run study.toml -o out.nc --quiet", ".journal", writes / 2);
  ASSERT_TRUE(first.is_paused()) << first.said();
  const Outcome second = gearsweep(folder_, "run study.toml -o out.nc --restart");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("in use by another run"));
}

TEST_F(DevicesTest, ADamagedJournalIsRefused) {
  for (const char* value : {"abc", "8", "0"}) {
    ASSERT_EQ(run_with_failure("launch", 150, "0").status, 1);
    ASSERT_EQ(run_in(folder_, std::string("python3 -c 'import sqlite3; d = sqlite3.connect(\"") +
                                  "out.nc.journal\"); d.execute(\"UPDATE sweep SET value=? WHERE "
                                  "name=?\", (\"" +
                                  value + "\", \"points of a tile\")); d.commit()'")
                  .status,
              0);
    const Outcome outcome = run("out.nc", "");
    EXPECT_EQ(outcome.status, 2) << value;
    EXPECT_THAT(outcome.err, HasSubstr("the journal is damaged")) << value;
    ASSERT_EQ(run("out.nc", "--quiet --restart").status, 0);
    folder_.remove("out.nc");
  }
}

TEST_F(DevicesTest, AListThatCannotBeReadIsRefused) {
  for (const auto& [list, words] :
       {std::pair{"99", "there is no device 99"}, std::pair{"0/0", "can be cut into 1 to"},
        std::pair{"0,,1", "is no list of numbers"}, std::pair{"every", "is no list of numbers"}}) {
    const Outcome outcome = run("out.nc", std::string("--device ") + list);
    EXPECT_EQ(outcome.status, 2) << list;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << list;
  }
}

}  // namespace
}  // namespace gearsweep::testing
