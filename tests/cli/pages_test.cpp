// What the documentation shows is so: its commands work in the order in which they stand on a page,
// its studies are studies, its Python runs, its links lead somewhere, and what it names is there.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/page.hpp"
#include "cli/small_shell.hpp"
#include "result/python.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

const std::filesystem::path kSource = GEARSWEEP_SOURCE;
const std::string kPackage = GEARSWEEP_PYTHON_FOLDER;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::vector<Page> documentation() {
  std::vector<Page> pages;
  for (const auto& path : all_pages()) pages.push_back(read_page(path));
  return pages;
}

// The gallery's commands are run by its own script, .readme/gallery, for as many pictures.
std::vector<std::filesystem::path> pages_but_the_gallery() {
  std::vector<std::filesystem::path> pages = all_pages();
  std::erase_if(pages, [](const auto& path) { return path.stem() == "gallery"; });
  return pages;
}

class Pages : public ::testing::TestWithParam<std::filesystem::path> {
 protected:
  const Page page_ = read_page(GetParam());
};

INSTANTIATE_TEST_SUITE_P(All, Pages, ::testing::ValuesIn(pages_but_the_gallery()),
                         [](const auto& page) {
                           return std::regex_replace(page.param.stem().string(),
                                                     std::regex("[^A-Za-z0-9]"), "_");
                         });

// A study, a style or a table of numbers begins with a comment that says under which name the
// commands find it.
TEST_P(Pages, CommandsWorkInTheirOrder) {
  const Folder folder;
  bool has_commands = false;
  std::string python;
  for (const Block& block : page_.blocks) {
    const std::string where = fmt::format("{}:{}", page_.name(), block.line);
    if (block.not_run) continue;
    if (block.language == "python") python += block.text;
    if (block.language == "toml" || block.language == "csv") {
      std::smatch name;
      const std::string first = first_line(block.text);
      ASSERT_TRUE(std::regex_match(first, name, std::regex("# ([a-z]+\\.(toml|csv))"))) << where;
      folder.write(name[1], block.text);
      // What has no axes is the style of a picture, which the next command takes.
      if (block.text.find("[[axes]]") == std::string::npos) continue;
      const Outcome read = run_small(folder, "gearsweep model --study " + name[1].str());
      ASSERT_EQ(read.status, 0) << where << "\n" << read.err;
    }
    if (block.language == "sh") {
      has_commands = true;
      const Outcome done = run_small(folder, block.text);
      ASSERT_EQ(done.status, 0) << where << "\n" << done.err;
    }
  }
  // What these pages are about has no commands, or none that a test can run.
  const std::set<std::string> without = {"accuracy", "architecture", "examples", "explore",
                                         "glossary", "library",      "python",   "validation"};
  EXPECT_EQ(has_commands, !without.contains(page_.name()));
  if (python.empty()) return;
  python = "import os, sys\nos.chdir(os.path.dirname(sys.argv[1]))\n" + python;
  const bool has_package = python.find("import gearsweep") != std::string::npos;
  if (has_package && kPackage.empty()) GTEST_SKIP() << "the Python package is not built";
  const Spoken said = has_package ? run_python(python, folder / "page", "gearsweep", kPackage)
                                  : run_python(python, folder / "page");
  EXPECT_EQ(said.status, 0) << said.text;
}

// A block in a language that nothing looks at would rot.
TEST(Documentation, BlocksAreInLanguagesThatAreChecked) {
  const std::set<std::string> checked = {"sh", "toml", "csv", "python", "cpp"};
  const std::set<std::string> only_shown = {"matlab", "cmake", "text"};
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    for (const Block& block : page.blocks) {
      EXPECT_TRUE(checked.contains(block.language) || only_shown.contains(block.language))
          << page.name() << ":" << block.line << " ```" << block.language;
    }
  }
}

TEST(Documentation, LinksLeadSomewhere) {
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    for (const std::string& link : page.links()) {
      if (link.starts_with("https://")) continue;
      const std::size_t hash = link.find('#');
      const std::string file = link.substr(0, hash);
      const std::filesystem::path target =
          file.empty() ? page.path : page.path.parent_path() / file;
      ASSERT_TRUE(std::filesystem::exists(target)) << link;
      if (hash == std::string::npos) continue;
      EXPECT_THAT(read_page(target).anchors(), Contains(link.substr(hash + 1))) << link;
    }
  }
}

// `host/cli/cli.cpp`, `zoo/` or, in C++, #include <study/study.hpp>. A word in capitals
// is for the reader to replace.
TEST(Documentation, FilesThatAreNamedExist) {
  const std::regex path("(host|kernels|zoo|tests|bench|doc|python|explore|\\.readme|\\.ci)/[^ *]*");
  const std::regex placeholder("[^A-Z]*[A-Z]{4,}[^A-Z]*");
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    for (const std::string& code : page.code()) {
      if (!std::regex_match(code, path) || std::regex_match(code, placeholder)) continue;
      EXPECT_TRUE(std::filesystem::exists(kSource / code)) << code;
    }
    const std::regex include("#include <([^>]+\\.hpp)>");
    for (const std::string& block : page.blocks_of("cpp")) {
      for (std::sregex_iterator at(block.begin(), block.end(), include), end; at != end; ++at) {
        EXPECT_TRUE(std::filesystem::exists(kSource / "host" / (*at)[1].str())) << (*at)[1];
      }
    }
  }
}

// A row of a table that names `functions()` and one `file` says where they stand.
TEST(Documentation, FunctionsStandInTheFilesBesideThem) {
  const std::regex function("`([A-Za-z_:]*?)([a-z_]+)\\(\\)`");
  const std::regex file("`((host|kernels)/[^`]*\\.[a-z]+)`");
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    std::istringstream lines(page.prose);
    for (std::string line; std::getline(lines, line);) {
      std::smatch found;
      if (!line.starts_with("|") || !std::regex_search(line, found, file)) continue;
      const std::string text = read_all(kSource / found[1].str());
      for (std::sregex_iterator at(line.begin(), line.end(), function), end; at != end; ++at) {
        EXPECT_NE(text.find((*at)[2].str() + "("), std::string::npos)
            << (*at)[2] << " in " << found[1];
      }
    }
  }
}

// In the middle of a sentence, too: `gearsweep plot`, `--zoom`.
TEST(Documentation, CommandsAndOptionsAreThere) {
  const Folder folder;
  const std::map<std::string, std::string> help = [&] {
    std::map<std::string, std::string> texts;
    for (const std::string command :
         {"run",     "merge",  "slurm",   "status",     "trace",     "plot",
          "export",  "top",    "floquet", "curves",     "reproduce", "studies",
          "model",   "gear",   "explore", "orders",     "report",    "tolerance",
          "devices", "verify", "bench",   "completion", "manual"}) {
      texts[command] = gearsweep(folder, command + " --help").out;
    }
    for (const std::string part : {"new", "import"}) {
      texts["gear"] += gearsweep(folder, "gear " + part + " --help").out;
    }
    return texts;
  }();
  std::string all;
  for (const auto& [command, text] : help) all += text;
  // Those of other programs.
  all += " --help --bind-to --prefix --out --small --table ";
  const std::regex option("--[a-z][a-z-]*");
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    for (const std::string& code : page.code()) {
      std::smatch command;
      std::string known = all;
      if (std::regex_search(code, command, std::regex("^gearsweep ([a-z]+)"))) {
        ASSERT_TRUE(help.contains(command[1])) << code;
        known = help.at(command[1]);
      }
      for (std::sregex_iterator at(code.begin(), code.end(), option), end; at != end; ++at) {
        EXPECT_TRUE(std::regex_search(known, std::regex(at->str() + "[^a-z-]"))) << code;
      }
    }
  }
}

// The table of the zoo is what the models' files give. It goes between the two comments, as the
// command prints it.
TEST(Documentation, TheZooHasTheAnswersOfItsFiles) {
  const Folder folder;
  const std::string command = "gearsweep model --answers", begin = "<!-- " + command + " -->\n",
                    end = "<!-- end of the answers -->";
  const std::string page = read_page(kSource / "doc/zoo.md").text;
  const std::size_t first = page.find(begin) + begin.size();
  EXPECT_EQ(page.substr(first, page.find(end) - first), gearsweep(folder, "model --answers").out)
      << "between the comments of doc/zoo.md belongs what '" << command << "' prints";
}

TEST(Documentation, LinesFitAScreen) {
  for (const Page& page : documentation()) {
    SCOPED_TRACE(page.name());
    std::istringstream lines(page.prose);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("|")) continue;
      EXPECT_LE(line.size(), 110U) << line;
    }
  }
}

TEST(Documentation, ReadmeIsReadInOneSitting) {
  const std::string text = read_page(kSource / "README.md").text;
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 180);
}

// Each page is told of where readers begin.
TEST(Documentation, ReadmeLeadsToEachPage) {
  const Page readme = read_page(kSource / "README.md");
  for (const auto& path : all_pages()) {
    if (path == readme.path) continue;
    EXPECT_THAT(readme.links(), Contains("doc/" + path.filename().string()));
  }
}

// Who copies the first two blocks has built the program and run its tests.
TEST(Documentation, TheFirstBlocksAreTheTwoCommands) {
  const std::vector<Block> blocks = read_page(kSource / "README.md").blocks;
  ASSERT_GE(blocks.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(blocks[i].language, "sh");
  EXPECT_THAT(blocks[0].text, HasSubstr("cmake --build --preset release"));
  EXPECT_THAT(blocks[1].text, HasSubstr("ctest --preset test"));
}

// A command that no test runs is a decision: it raises this number.
TEST(Documentation, FewBlocksAreNotRun) {
  constexpr std::size_t kNotRun = 17;
  std::size_t count = 0;
  for (const auto& path : all_pages()) {
    for (const Block& block : read_page(path).blocks) {
      if (!block.not_run) continue;
      ++count;
      std::cout << path.filename().string() << ":" << block.line
                << " is not run: " << *block.not_run << "\n";
    }
  }
  EXPECT_EQ(count, kNotRun);
}

}  // namespace
}  // namespace gearsweep::testing
