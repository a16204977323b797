// gearsweep verify, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"

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

TEST(Verify, UnknownDevicesAreRefused) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "verify --device 99");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("no device 99"), HasSubstr("gearsweep devices")));
}

}  // namespace
}  // namespace gearsweep::testing
