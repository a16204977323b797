// Examples are what people copy: each study that the pages, the manual or the program itself offers
// runs in minutes, and its files are small.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "cli/page.hpp"
#include "plan/plan.hpp"
#include "plot/style.hpp"
#include "result/result_size.hpp"
#include "study/builtin_studies.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

// As the forecast bounds it; the largest built-in study needs a third of it.
constexpr double kMaxBytes = 2e7;
// A minute or two at 3e8 steps per second, which two cores make.
constexpr double kMaxSteps = 5e10;

void expect_sensible(const Study& study, const std::string& where) {
  EXPECT_LE(size_of_result(study, {}).file, kMaxBytes) << where;
  EXPECT_LE(Plan(study, 1024).total_work(), kMaxSteps) << where;
}

// The words of a command as a shell takes them, up to a comment or the next command.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  char quote = '\0';
  for (const char letter : command) {
    if (quote != '\0') {
      if (letter == quote) quote = '\0';
      if (quote != '\0') words.back() += letter;
    } else if (letter == '\'' || letter == '"') {
      quote = letter;
    } else if (letter == '\n' || letter == '#' || letter == '&' || letter == '|') {
      break;
    } else if (letter != ' ') {
      words.back() += letter;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

// "run coarse-map --set a=b": each run of a built-in study in a text, as a study.
std::vector<Study> runs_in(std::string text) {
  for (std::size_t at = 0; (at = text.find("\\\n", at)) != std::string::npos;) text.erase(at, 2);
  const std::string command = "gearsweep run ";
  std::vector<Study> studies;
  for (std::size_t at = 0; (at = text.find(command, at)) != std::string::npos;) {
    at += command.size();
    const std::vector<std::string> words = words_of(text.substr(at));
    const auto builtin = builtin_studies().find(words.front() + ".toml");
    if (builtin == builtin_studies().end()) continue;
    std::vector<std::string> overrides;
    for (std::size_t i = 1; i + 1 < words.size(); ++i) {
      if (words[i] == "--set") overrides.push_back(words[i + 1]);
    }
    studies.push_back(read_study(builtin->second, words.front(), overrides));
  }
  return studies;
}

TEST(Examples, BuiltInStudiesAreSensible) {
  for (const auto& [name, text] : builtin_studies()) expect_sensible(read_study(text, name), name);
}

bool is_study(const std::string& text) {
  return text.find("[[axes]]") != std::string::npos || text.find("[points]") != std::string::npos ||
         text.find("[uncertain]") != std::string::npos;
}
bool is_model(const std::string& text) { return text.find("[equations]") != std::string::npos; }

// "# mine.toml" in the first line of a text.
void write_as_named(const Folder& folder, const std::string& text) {
  folder.write(text.substr(2, text.find('\n') - 2), text);
}

// A page's models and tables lie beside its studies, under the names in their first lines.
TEST(Examples, StudiesOfThePagesAreSensible) {
  std::size_t count = 0;
  for (const auto& path : all_pages()) {
    const Folder folder;
    const Page page = read_page(path);
    for (const std::string& table : page.blocks_of("csv")) write_as_named(folder, table);
    for (const std::string& text : page.blocks_of("toml")) {
      if (is_model(text)) write_as_named(folder, text);
      if (!is_study(text)) continue;
      ++count;
      expect_sensible(read_study(text, folder / path.filename().string()), text);
    }
  }
  EXPECT_GT(count, 1U);
}

// What is neither a study nor a model is the style of a picture.
TEST(Examples, StylesOfThePagesAreStyles) {
  const Folder folder;
  std::size_t count = 0;
  for (const auto& path : all_pages()) {
    for (const std::string& style : read_page(path).blocks_of("toml")) {
      if (is_study(style) || is_model(style)) continue;
      ++count;
      folder.write("style.toml", style);
      PlotStyle read;
      EXPECT_NO_THROW(read_style_file(folder / "style.toml", &read)) << style;
    }
  }
  EXPECT_GT(count, 0U);
}

TEST(Examples, CommandsOfThePagesAreSensible) {
  std::size_t count = 0;
  for (const auto& path : all_pages()) {
    for (const Study& study : runs_in(read_page(path).text)) {
      ++count;
      expect_sensible(study, path.filename().string() + "\n" + study.toml);
    }
  }
  EXPECT_GT(count, 20U);
}

// The manual page holds the help of every command.
TEST(Examples, CommandsOfTheManualAreSensible) {
  const Folder folder;
  const std::string manual = run_in(folder, GEARSWEEP_BINARY " manual | tr -d '\\\\'").out;
  const std::vector<Study> studies = runs_in(manual);
  EXPECT_GT(studies.size(), 2U);
  for (const Study& study : studies) expect_sensible(study, study.toml);
}

// A cut of a map is at a value of one of its own axes.
TEST(Examples, PlotsOfTheManualFitTheMapOfItsFirstExample) {
  const Folder folder;
  const std::string manual = run_in(folder, GEARSWEEP_BINARY " manual | tr -d '\\\\'").out;
  const Study study = read_study(builtin_studies().at("coarse-map.toml"), "coarse-map");
  std::vector<std::string> axes;
  for (const Axis& axis : study.axes) axes.push_back(axis.name);
  const std::string command = "gearsweep plot map.nc ";
  std::size_t cuts = 0;
  for (std::size_t at = 0; (at = manual.find(command, at)) != std::string::npos; ++at) {
    const std::vector<std::string> words = words_of(manual.substr(at));
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
      if (words[i] != "--at") continue;
      ++cuts;
      EXPECT_THAT(axes, ::testing::Contains(words[i + 1].substr(0, words[i + 1].find('='))));
    }
  }
  EXPECT_GT(cuts, 0U);
}

}  // namespace
}  // namespace gearsweep::testing
