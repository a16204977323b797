// The manual page and the completion scripts: whole, valid, and right for what a user types.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "study/study_keys.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

// What matches the first group of the pattern, line by line.
std::vector<std::string> found_in(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

// The commands and options as help lists them.
struct Help {
  std::vector<std::string> commands;
  std::map<std::string, std::vector<std::string>> options;  // by command

  explicit Help(const Folder& folder) {
    const std::string help = gearsweep(folder, "--help").out;
    commands = found_in(help.substr(help.find("Subcommands:")), "\n  ([a-z]+)  ");
    for (const std::string& command : commands) {
      options[command] =
          found_in(gearsweep(folder, command + " --help").out, "\n  (?:-[a-z],)?(--[a-z-]+)");
    }
  }
};

// roff's sign for a dash.
std::string in_roff(const std::string& text) {
  return std::regex_replace(text, std::regex("-"), "\\-");
}

TEST(Manual, HasEveryCommandWithItsOptions) {
  const Folder folder;
  const Help help(folder);
  ASSERT_THAT(help.commands, IsSupersetOf({"run", "plot", "verify", "manual"}));
  ASSERT_THAT(help.options.at("run"), IsSupersetOf({"--help", "--output", "--set", "--device"}));
  const std::string page = gearsweep(folder, "manual").out;
  for (const std::string& command : help.commands) {
    const std::size_t begin = page.find("\n.SS " + command + "\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string part = page.substr(begin, page.find("\n.S", begin + 1) - begin);
    for (const std::string& option : help.options.at(command)) {
      if (option == "--help") continue;
      EXPECT_THAT(part, HasSubstr("\\fB" + in_roff(option) + "\\fR")) << command;
    }
  }
  for (const char* title : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS", "EXIT STATUS",
                            "ENVIRONMENT", "FILES", "EXAMPLES"}) {
    EXPECT_THAT(page, HasSubstr("\n.SH " + std::string(title) + "\n"));
  }
}

// As they stand on the page, in its order: a heading for each table, a tag for each key.
std::vector<std::string> keys_on(const std::string& page) {
  return found_in(page, "\n((?:\\.SS [^\n]+)|(?:\\.TP\n\\\\f[BI][^\\\\]+))");
}

TEST(Manual, OfStudiesHasEveryKeyThatTheReaderKnowsAndNoOther) {
  const Folder folder;
  std::vector<std::string> expected;
  for (const StudyTable& table : study_tables()) {
    expected.push_back(".SS " + (table.name.empty() ? "Before the first table" : table.heading));
    for (const StudyKey& key : table.keys) {
      expected.push_back(std::string(".TP\n\\f") + (key.is_pattern ? "I" : "B") + key.name);
    }
  }
  const std::string page = gearsweep(folder, "manual study").out;
  EXPECT_EQ(keys_on(page), expected);
  EXPECT_THAT(page, HasSubstr("From 1 to 1024. Default: 16.\n")) << "of integrate.extend";
  EXPECT_THAT(gearsweep(folder, "manual").out, HasSubstr("\n.BR gearsweep\\-study (5),\n"));
  EXPECT_THAT(gearsweep(folder, "help").out, HasSubstr("manual study"));
}

TEST(Manual, ItsExampleIsAStudy) {
  const Folder folder;
  const std::string page = gearsweep(folder, "manual study").out;
  const std::size_t begin = page.find(".nf\n.RS\n") + 8;
  std::string example = page.substr(begin, page.find(".RE\n", begin) - begin);
  example = std::regex_replace(example, std::regex("\\\\-"), "-");
  folder.write("example.toml", std::regex_replace(example, std::regex("\\\\\\(aq"), "'"));
  const Outcome outcome = gearsweep(folder, "model --study example.toml");
  EXPECT_EQ(outcome.status, 0) << outcome.err << example;
}

TEST(Manual, HelpOnACommandIsItsHelp) {
  const Folder folder;
  EXPECT_EQ(gearsweep(folder, "help run").out, gearsweep(folder, "run --help").out);
  EXPECT_EQ(gearsweep(folder, "help").out, gearsweep(folder, "--help").out);
  EXPECT_EQ(gearsweep(folder, "help rnu").status, 2);
}

// For whoever has no man: the same page without a sign of roff, as wide as a terminal.
TEST(Manual, IsPlainTextWhereItIsAskedFor) {
  const Folder folder;
  const std::string page = gearsweep(folder, "manual study --text").out;
  std::vector<std::string> keys;
  for (const StudyTable& table : study_tables()) {
    for (const StudyKey& key : table.keys) {
      EXPECT_THAT(page, HasSubstr("\n    " + key.name + " (" + key.type + ")\n"));
    }
  }
  EXPECT_THAT(page, HasSubstr("\n        [model]\n        name = \"gear5\"\n"))
      << "an example keeps its lines";
  for (const char* name : {"manual --text", "manual study --text"}) {
    for (const std::string& line : found_in(gearsweep(folder, name).out, "([^\n]*)\n")) {
      EXPECT_THAT(line, Not(HasSubstr("\\f")));
      EXPECT_FALSE(line.starts_with('.')) << line;
      // Examples, which stand deeper, and options with their choices are as long as they are.
      const bool is_kept = line.starts_with("        ") || line.starts_with("    -");
      EXPECT_TRUE(line.size() <= 80 || is_kept) << line;
    }
  }
}

// A line that begins with a dot is a request to roff: all of them are ours, none is from a text.
class ManualPage : public ::testing::TestWithParam<const char*> {};

TEST_P(ManualPage, OnlyRequestsBeginWithADot) {
  const Folder folder;
  const std::string page = '\n' + gearsweep(folder, GetParam()).out;
  for (const std::string& request : found_in(page, "\n([.'][^ \n]*)")) {
    EXPECT_THAT((std::vector<std::string>{".TH", ".SH", ".SS", ".PP", ".TP", ".br", ".nf", ".fi",
                                          ".RS", ".RE", ".BR"}),
                Contains(request));
  }
  EXPECT_THAT(page, Not(HasSubstr("\n\n"))) << "an empty line is space in any case";
}

INSTANTIATE_TEST_SUITE_P(All, ManualPage, ::testing::Values("manual", "manual study"));

class BashTest : public ::testing::Test {
 protected:
  BashTest() { folder_.write("script.bash", gearsweep(folder_, "completion bash").out); }

  // What bash offers for the last of the words.
  std::vector<std::string> offered(const std::string& words, int last) {
    folder_.write("complete.bash", "source script.bash\nCOMP_WORDS=(" + words +
                                       ")\nCOMP_CWORD=" + std::to_string(last) +
                                       "\n_gearsweep\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome outcome = run_in(folder_, "bash complete.bash");
    EXPECT_EQ(outcome.err, "");
    return found_in(outcome.out, "([^\n]+)\n");
  }

  Folder folder_;
};

TEST_F(BashTest, ParsesTheScript) {
  const Outcome outcome = run_in(folder_, "bash -n script.bash");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(BashTest, OffersCommands) {
  EXPECT_THAT(offered("gearsweep ru", 1), ElementsAre("run"));
  EXPECT_THAT(offered("gearsweep --ver", 1), ElementsAre("--version"));
  const Help help(folder_);
  EXPECT_THAT(offered("gearsweep ''", 1), IsSupersetOf(help.commands));
}

TEST_F(BashTest, OffersEveryOptionOfEveryCommand) {
  const Help help(folder_);
  for (const std::string& command : help.commands) {
    EXPECT_THAT(offered("gearsweep " + command + " --", 2), IsSupersetOf(help.options.at(command)))
        << command;
  }
  EXPECT_THAT(offered("gearsweep run coarse-map --res", 3), ElementsAre("--restart"));
}

TEST_F(BashTest, OffersStudiesAndTheFilesThatFit) {
  folder_.write("mine.toml", "");
  folder_.write("mine.nc", "");
  folder_.write("mine.txt", "");
  std::filesystem::create_directory(folder_ / "mined");
  EXPECT_THAT(offered("gearsweep run mi", 2), ElementsAre("mined", "mine.nc", "mine.toml"));
  EXPECT_THAT(offered("gearsweep run coarse-m", 2), ElementsAre("coarse-map"));
  EXPECT_THAT(offered("gearsweep plot mi", 2), ElementsAre("mined", "mine.nc"));
  EXPECT_THAT(offered("gearsweep plot mine.nc -o mi", 4),
              IsSupersetOf({"mine.nc", "mine.toml", "mine.txt", "mined"}));
  EXPECT_THAT(offered("gearsweep reproduce -o mi", 3), ElementsAre("mined"));
  EXPECT_THAT(offered("gearsweep studies ued", 2), ElementsAre("ueda-map"));
  EXPECT_THAT(offered("gearsweep model pend", 2), ElementsAre("pendulum"));
  EXPECT_THAT(offered("gearsweep reproduce --preset c", 3), ElementsAre("consistent"));
  EXPECT_THAT(offered("gearsweep run coarse-map --device ''", 4), ElementsAre());
}

TEST(Completion, FishHasEveryCommandWithItsOptions) {
  const Folder folder;
  const Help help(folder);
  const std::string script = gearsweep(folder, "completion fish").out;
  for (const std::string& command : help.commands) {
    EXPECT_THAT(script, HasSubstr(" -a " + command + " "));
    for (const std::string& option : help.options.at(command)) {
      const std::regex line("seen_subcommand_from " + command + "'.* -l " + option.substr(2) + " ");
      EXPECT_TRUE(std::regex_search(script, line)) << command << " " << option;
    }
  }
}

TEST(Completion, OtherShellsAreRefused) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "completion fihs");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'fish'?"));
}

}  // namespace
}  // namespace gearsweep::testing
