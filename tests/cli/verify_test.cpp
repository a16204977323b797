// gearsweep verify, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Verify, PassesAndSaysSoInTheLastLine) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "verify");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("pass     reference orbits"), Not(HasSubstr("FAIL")),
                                 EndsWith("\npass: 14 checks\n")));
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(folder.files(), std::set<std::string>());
}

TEST(Verify, FailsWhereNoFileCanBeWritten) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, "TMPDIR=/nonexistent " + std::string(GEARSWEEP_BINARY) + " verify");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out,
              AllOf(ContainsRegex("\nFAIL     file and back .*folder for temporary files"),
                    EndsWith("\nFAIL: 1 of 14 checks failed\n")));
}

TEST(Verify, ScriptsReadJson) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "verify --json");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"verdict\": \"pass: 14 checks\""),
                                 HasSubstr("\"name\": \"same bits\""), HasSubstr("\"seen\": ")));
}

const std::string kLine =
    "[model]\nname = 'line'\n[states]\nx = {}\n[parameters]\nslope = 1.0\n[equations]\nx = "
    "'slope'\n"
    "[forcing]\nperiod = '1'\n";
const std::string kAnswer =
    "[[answers]]\nquantity = 'x_max'\nat = { slope = 0.5, x = 1.0 }\nsettle = 1\nrecord = 2\n"
    "extend = 1\nvalue = 2.5\ntolerance = 1e-9\nsource = 'x = 1 + slope t'\n";

TEST(Verify, AnswersOfAFileHoldOrFail) {
  const Folder folder;
  folder.write("line.toml", kLine + kAnswer);
  const Outcome right = gearsweep(folder, "verify --model line.toml");
  EXPECT_EQ(right.status, 0) << right.out << right.err;
  EXPECT_THAT(right.out, AllOf(ContainsRegex("ok +line +x_max +2.5 +2.5 .* 1e-09  slope = 0.5"),
                               EndsWith("\npass: 1 numbers\n")));
  folder.write("line.toml", kLine + kAnswer + replaced(kAnswer, "2.5", "2.6"));
  const Outcome wrong = gearsweep(folder, "verify --model line.toml");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.out, AllOf(ContainsRegex("FAIL +line +x_max +2.6 +2.5 +-1.0e-01"),
                               EndsWith("\nFAIL: 1 of 2 numbers are wrong\n")));
  const Outcome json = gearsweep(folder, "verify --model line.toml --json");
  EXPECT_EQ(json.status, 1);
  EXPECT_THAT(json.out, AllOf(HasSubstr("\"published\": 2.6"), HasSubstr("\"slope\": 0.5"),
                              HasSubstr("\"verdict\": \"FAIL\"")));
}

TEST(Verify, AModelWithoutAnswersIsRefused) {
  const Folder folder;
  folder.write("line.toml", kLine);
  const Outcome none = gearsweep(folder, "verify --model line.toml");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("model 'line' has no known answers"));
  const Outcome unknown = gearsweep(folder, "verify --model hertzz");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'hertz'?"));
}

TEST(Verify, TheZooHolds) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "verify --zoo");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(ContainsRegex("ok +vanderpol"), Not(HasSubstr("FAIL")),
                                 ContainsRegex("\npass: [0-9]+ numbers\n$")));
}

TEST(Verify, UnknownDevicesAreRefused) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "verify --device 99");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("no device 99"), HasSubstr("gearsweep devices")));
}

}  // namespace
}  // namespace gearsweep::testing
