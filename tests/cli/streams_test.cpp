// Standard streams that are closed, full or gone: no file is written into instead, no run is lost
// for what it tells, and no answer is lost unnoticed.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/standard_streams.hpp"
#include "support/process.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// Four tiles.
const std::string kStreamsStudy = coarse_study(16, 0, R"([integrate]
settle = 20
record = 5
tile = 4
[observe]
quantities = ["x1_rms", "poincare"]
)");

class StreamsTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kStreamsStudy); }

  // With these redirections: what the shell then still catches is all that the program says.
  Outcome run(const std::string& arguments, const std::string& redirections) {
    return run_in(folder_, "{ " + std::string(GEARSWEEP_BINARY) + " " + arguments + " " +
                               redirections + "; }");
  }

  // A pipe whose reader is gone, as descriptor 9.
  Outcome run_with_broken_pipe(const std::string& arguments, const std::string& redirection) {
    return run_in(folder_, "mkfifo gone && { exec 8<>gone 9>gone 8>&-; rm gone; " +
                               std::string(GEARSWEEP_BINARY) + " " + arguments + " " + redirection +
                               "; }");
  }

  void expect_unwritten(const std::string& command, const std::string& nowhere) {
    const Outcome outcome = run(command, nowhere);
    EXPECT_EQ(outcome.status, 1) << command << nowhere;
    EXPECT_THAT(outcome.err, HasSubstr("gearsweep: cannot write to standard output: ")) << command;
  }

  std::string difference() const {
    return difference_of_results(folder_ / "out.nc", folder_ / "whole.nc");
  }

  Folder folder_;
};

// The last stream alone, and all: then a file takes the place of each of them in turn.
const char* const kClosings[] = {"2>&-", "<&- >&- 2>&-"};

TEST_F(StreamsTest, NoFileTakesThePlaceOfAClosedStream) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  ASSERT_EQ(gearsweep(folder_, "trace study.toml --at omega=0.7 -o whole.csv --quiet").status, 0);
  for (const std::string closing : kClosings) {
    // The second run reads all tiles from the journal of the first.
    for (int time = 0; time < 2; ++time) {
      ASSERT_EQ(run("run study.toml -o out.nc --keep-journal", closing).status, 0) << closing;
      EXPECT_EQ(difference(), "") << closing;
      EXPECT_THAT(gearsweep(folder_, "status out.nc.journal").out, HasSubstr("100.0 % done"));
    }
    folder_.remove("out.nc.journal");
    ASSERT_EQ(run("run study.toml -o shard.nc --shard 1/1", closing).status, 0) << closing;
    ASSERT_EQ(run("merge shard.nc.shard-1-of-1.journal -o out.nc", closing).status, 0) << closing;
    EXPECT_EQ(difference(), "") << closing;
    folder_.remove("shard.nc.shard-1-of-1.journal");
    ASSERT_EQ(run("trace study.toml --at omega=0.7 -o out.csv", closing).status, 0) << closing;
    EXPECT_EQ(read_all(folder_ / "out.csv"), read_all(folder_ / "whole.csv")) << closing;
    ASSERT_EQ(run("plot out.nc -o out.svg", closing).status, 0) << closing;
    EXPECT_THAT(read_all(folder_ / "out.svg"), HasSubstr("</svg>")) << closing;
  }
}

TEST_F(StreamsTest, AnAnswerIsTheSameWithoutTheOtherStreams) {
  const std::string command = "floquet study.toml --at omega=0.7";
  const std::string answer = gearsweep(folder_, command).out;
  EXPECT_THAT(answer, HasSubstr("multiplier"));
  EXPECT_EQ(run(command, "<&- 2>&-").out, answer);
}

TEST_F(StreamsTest, AnAnswerThatCannotBeWrittenIsAFailure) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  for (const char* command : {"--help",
                              "--version",
                              "run --help",
                              "studies",
                              "studies --json",
                              "studies coarse-map",
                              "model",
                              "model gear5",
                              "model gear5 --json",
                              "model --study study.toml",
                              "devices",
                              "devices --json",
                              "completion bash",
                              "completion fish",
                              "manual",
                              "status whole.nc",
                              "status whole.nc --json",
                              "run study.toml -o out.nc --dry-run",
                              "run study.toml -o out.nc --dry-run --json",
                              "run study.toml -o out.nc --quiet --json",
                              "run study.toml -o out.nc --quiet --shard 1/1 --json",
                              "floquet study.toml --at omega=0.7",
                              "floquet study.toml --at omega=0.7 --json",
                              "verify"}) {
    expect_unwritten(command, ">/dev/full");
  }
  for (const char* command : {"--help", "model gear5 --json", "run study.toml -o out.nc --json"}) {
    expect_unwritten(command, ">&-");
  }
  EXPECT_EQ(difference(), "") << "the result was there before its summary";
}

TEST_F(StreamsTest, AReaderThatHasSeenEnoughIsNotComplainedTo) {
  const Outcome outcome = run_with_broken_pipe("model gear5", ">&9");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(StreamsTest, ProgressThatCannotBeWrittenIsNotWorthARun) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  EXPECT_EQ(run("run study.toml -o out.nc --plot out.svg", "2>/dev/full").status, 0);
  EXPECT_EQ(difference(), "");
  EXPECT_EQ(run("trace study.toml --at omega=0.7 -o out.csv", "2>/dev/full").status, 0);
  EXPECT_EQ(run("run nowhere.toml", "2>/dev/full").status, 2);
  folder_.remove("out.nc");
  EXPECT_EQ(run_with_broken_pipe("run study.toml -o out.nc", "2>&9").status, 0);
  EXPECT_EQ(difference(), "");
}

TEST_F(StreamsTest, ATerminalThatIsGoneIsNotWorthARun) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) {
    GTEST_SKIP() << "there are no terminals here";
  }
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  ASSERT_EQ(dup2(terminal, 9), 9);
  close(terminal);
  close(master);
  EXPECT_EQ(run("run study.toml -o out.nc", "2>&9").status, 0);
  close(9);
  EXPECT_EQ(difference(), "");
}

TEST_F(StreamsTest, JsonIsUtf8WhateverTheNameOfTheFile) {
  const Outcome run = gearsweep(folder_, "run study.toml --quiet --json -o '\xff.nc'");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\"\xef\xbf\xbd.nc\""));
  EXPECT_EQ(gearsweep(folder_, "status --json '\xff.nc'").status, 0);
}

TEST_F(StreamsTest, ATextOfAFileGivesTheTerminalNoOrders) {
  folder_.write("red.toml", "title = \"\\u001b[31mred\"\n" + std::string(kStreamsStudy));
  ASSERT_EQ(gearsweep(folder_, "run red.toml -o out.nc --quiet").status, 0);
  EXPECT_THAT(gearsweep(folder_, "run study.toml -o out.nc --quiet").err,
              HasSubstr("the result of another study, '?[31mred'"));
}

TEST(Printable, LettersStayAndOrdersDoNot) {
  const std::string letters = "größer\n\tω ≥ 0, \xff";
  EXPECT_EQ(printable(letters), letters);
  EXPECT_EQ(printable("\x1b[2J\r\x07\x7f\xc2\x9b" + std::string(1, '\0')), "?[2J?????");
}

}  // namespace
}  // namespace gearsweep::testing
