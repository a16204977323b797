// The page to print (doc/site/cheat_sheet.html): its study, its commands and its Python work.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/page.hpp"
#include "cli/small_shell.hpp"
#include "result/python.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

class CheatSheet : public ::testing::Test {
 protected:
  // The one block between <pre> and </pre> that begins so.
  std::string block(const std::string& beginning) const {
    std::vector<std::string> blocks = matches_in(page_, "<pre>([^<]*)</pre>");
    std::erase_if(blocks, [&](const std::string& text) { return !text.starts_with(beginning); });
    return blocks.size() == 1 ? blocks.front() : throw std::logic_error("no block " + beginning);
  }

  const std::string page_ =
      read_all(std::filesystem::path(GEARSWEEP_SOURCE) / "doc/site/cheat_sheet.html");
  const Folder folder_;
};

TEST_F(CheatSheet, ItsStudyIsAStudy) {
  folder_.write("study.toml", block("[model]"));
  const Outcome read = run_small(folder_, "gearsweep run study.toml --dry-run");
  EXPECT_EQ(read.status, 0) << read.err;
}

TEST_F(CheatSheet, ItsFirstCommandsMakeAMap) {
  std::string commands = block("gearsweep studies");
  const std::size_t server = commands.find("gearsweep explore");  // it would wait for a browser
  ASSERT_NE(server, std::string::npos);
  const Outcome done = run_small(folder_, commands.substr(0, server));
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(folder_.files().contains("map.png"));
}

TEST_F(CheatSheet, ItsGearGivesItsPages) {
  const Outcome done = run_small(folder_, block("gearsweep gear new"));
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(folder_.files().contains("pair.html"));
  EXPECT_TRUE(folder_.files().contains("tolerance.html"));
}

TEST_F(CheatSheet, ItsCommandsAndOptionsAreThere) {
  const std::vector<std::string> first_cells = matches_in(page_, "<tr><td>([^<]*)</td>");
  ASSERT_GT(first_cells.size(), 20U);
  const std::string commands = gearsweep(folder_, "--help").out;
  int count = 0;
  for (const std::string& cell : first_cells) {
    std::smatch words;
    // A command in small letters and what it works on: "run S --dry-run", "verify".
    if (!std::regex_match(cell, words, std::regex("([a-z]+)( [A-Z].*)?"))) continue;
    if (words[2].length() == 0 && words[1] != "verify") continue;
    ++count;
    EXPECT_THAT(commands, HasSubstr("\n  " + words[1].str() + " ")) << cell;
    const std::string help = gearsweep(folder_, words[1].str() + " --help").out;
    for (const std::string& option : matches_in(words[2], "( --?[a-z-]+)")) {
      EXPECT_TRUE(std::regex_search(help, std::regex("[ ,]" + option.substr(1) + "[ ,]")))
          << cell << ": " << option;
    }
  }
  EXPECT_GE(count, 13);
}

TEST_F(CheatSheet, ItsPythonRuns) {
  const std::string package = GEARSWEEP_PYTHON_FOLDER;
  if (package.empty()) GTEST_SKIP() << "the Python package is not built";
  // Few points, few periods: only that it works is to be shown.
  std::string python = block("import gearsweep");
  for (const std::string count : {"160", "120"}) {
    const std::size_t at = python.find(count);
    ASSERT_NE(at, std::string::npos) << count;
    python.replace(at, count.size(), "6");
  }
  const std::string run = "study.run()";
  const std::size_t at = python.find(run);
  ASSERT_NE(at, std::string::npos);
  python.replace(at, run.size(), "study.run(set={'integrate.settle': 20, 'integrate.record': 20})");
  const Spoken said =
      run_python("import os, sys\nos.chdir(os.path.dirname(sys.argv[1]))\n" + python,
                 folder_ / "page", "gearsweep", package);
  EXPECT_EQ(said.status, 0) << said.text;
}

}  // namespace
}  // namespace gearsweep::testing
