// Where the driver cannot keep compiled kernels, the program gives it a folder for as long as it
// runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/same_result.hpp"

namespace gearsweep::testing {
namespace {

const char* const kKernelCacheStudy =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.8]\n"
    "[integrate]\nsettle = 20\nrecord = 4\n[observe]\nquantities = ['x1_rms']\n";

class KernelCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("study.toml", kKernelCacheStudy);
    std::filesystem::create_directory(folder_ / "tmp");
    ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  }

  // A command that finds its caches there, and its temporary files in tmp/.
  static std::string command(const std::string& caches, const std::string& arguments) {
    return "env -u POCL_CACHE_DIR -u XDG_CACHE_HOME TMPDIR=tmp " + caches + " " GEARSWEEP_BINARY +
           " " + arguments;
  }

  std::string difference(const std::string& result) const {
    return difference_of_results(folder_ / result, folder_ / "whole.nc");
  }

  Folder folder_;
};

TEST_F(KernelCacheTest, NoDriverNeedsAFolderThatCanBeWritten) {
  const std::string devices = gearsweep(folder_, "devices").out;
  for (const char* caches : {"XDG_CACHE_HOME=/proc", "HOME=/proc", "HOME=/dev/null"}) {
    EXPECT_EQ(run_in(folder_, command(caches, "devices")).out, devices) << caches;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp")) << caches;
  }
}

TEST_F(KernelCacheTest, RunsWithoutOneDoNotDisturbEachOtherAndLeaveNothing) {
  const auto run = [](const std::string& output) {
    return command("HOME=/proc", "run study.toml --quiet -o " + output);
  };
  const Outcome outcome =
      run_in(folder_, "{ " + run("a.nc") + " & " + run("b.nc") + "; b=$?; wait $!; echo $? $b; }");
  EXPECT_EQ(outcome.out, "0 0\n") << outcome.err;
  EXPECT_EQ(difference("a.nc"), "");
  EXPECT_EQ(difference("b.nc"), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
}

TEST_F(KernelCacheTest, AFolderThatCanBeWrittenIsLeftToTheDriver) {
  std::filesystem::create_directory(folder_ / "caches");
  EXPECT_EQ(run_in(folder_, command("XDG_CACHE_HOME=caches", "devices")).status, 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "caches")) {
    EXPECT_EQ(entry.path().filename(), "pocl");
  }
}

}  // namespace
}  // namespace gearsweep::testing
