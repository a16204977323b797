#include "cli/detail/option_table.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  entry.is_positional = option.get_positional();
  if (entry.is_positional) entry.names = {option.get_name()};
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) entry.value = option.get_type_name();
  entry.description = option.get_description();
  entry.is_required = option.get_required();
  entry.may_repeat = option.get_expected_max() > 1;
  return entry;
}

CommandEntry entry_of(const CLI::App& command) {
  CommandEntry entry{command.get_name(), command.get_description(), command.get_footer(), {}};
  for (const CLI::Option* option : command.get_options())
    entry.options.push_back(entry_of(*option));
  std::stable_partition(entry.options.begin(), entry.options.end(),
                        [](const OptionEntry& option) { return option.is_positional; });
  return entry;
}

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table{entry_of(app), {}};
  for (const CLI::App* command : app.get_subcommands({})) {
    table.commands.push_back(entry_of(*command));
  }
  return table;
}

}  // namespace gearsweep
