// The commands and their options as plain data, read off the parser: what the manual and the
// shells' completion are made from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gearsweep {

struct OptionEntry {
  std::vector<std::string> names;  // "-o", "--output"; of an argument without dashes its name
  std::string value;               // the name of its value's type; empty: a flag
  std::string description;
  bool is_positional = false, is_required = false, may_repeat = false;
};

struct CommandEntry {
  std::string name, description, footer;
  std::vector<OptionEntry> options;  // arguments without dashes first
};

struct CommandTable {
  CommandEntry whole;  // the tool itself, before a command
  std::vector<CommandEntry> commands;
};

CommandTable command_table(const CLI::App& app);

}  // namespace gearsweep
