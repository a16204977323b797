// gearsweep completion, gearsweep manual, gearsweep help: what the shell, man and users want to
// know of the commands.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/completion.hpp"
#include "cli/detail/manual.hpp"
#include "cli/detail/roff_page.hpp"
#include "cli/detail/study_manual.hpp"
#include "cli/standard_streams.hpp"

namespace gearsweep {

namespace {

// bashcompinit needs compinit, which a ~/.zshrc may lack.
constexpr const char* kZshHead =
    "(( $+functions[compdef] )) || { autoload -Uz compinit && compinit -i }\n"
    "autoload -Uz bashcompinit && bashcompinit\n";

}  // namespace

void add_completion_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("completion", "Print the completion script of a shell");
  const auto shell = std::make_shared<std::string>();
  add_choice(command, "shell", shell.get(), {"bash", "zsh", "fish"}, "Which shell")->required();
  command->footer(
      "Examples:\n"
      "  source <(gearsweep completion bash)\n"
      "  gearsweep completion fish > ~/.config/fish/completions/gearsweep.fish");
  command->callback([app, shell] {
    const CommandTable table = command_table(*app);
    if (*shell == "zsh") answer("{}", kZshHead);
    answer("{}", *shell == "fish" ? fish_completion(table) : bash_completion(table));
  });
}

void add_manual_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("manual", "Print a manual page");
  const auto page = std::make_shared<std::string>("gearsweep");
  const auto is_text = std::make_shared<bool>(false);
  add_choice(command, "page", page.get(), {"gearsweep", "study"},
             "gearsweep (the default): commands and options; study: the keys of a study");
  command->add_flag("--text", *is_text,
                    "Plain text, which a terminal gets in any case; else as man takes it");
  command->footer(
      "Examples:\n"
      "  gearsweep manual study\n"
      "  gearsweep manual study --text | less\n"
      "  gearsweep manual study | man -l -");
  command->callback([app, page, is_text] {
    const std::string roff =
        *page == "study" ? study_manual_page() : manual_page(command_table(*app));
    const std::optional<int> columns = terminal_columns(StandardStream::output);
    const bool is_plain = *is_text || columns;
    // Longer lines are hard to read.
    constexpr int kMostColumns = 100;
    answer("{}", is_plain ? plain_page(roff, std::min(columns.value_or(80), kMostColumns)) : roff);
  });
}

void add_help_command(CLI::App* app) {
  std::vector<std::string> commands;
  for (const CLI::App* one : app->get_subcommands({})) commands.push_back(one->get_name());
  CLI::App* command = app->add_subcommand("help", "Help on a command, as with --help");
  const auto about = std::make_shared<std::string>();
  add_choice(command, "command", about.get(), commands, "Which command");
  command->footer("Example: gearsweep help run");
  command->callback([app, about] {
    const bool is_whole = about->empty();
    const CLI::App* one = is_whole ? app : app->get_subcommand(*about);
    const std::string name = is_whole ? app->get_name() : app->get_name() + " " + *about;
    // app->help() would be the help of this command.
    answer("{}", app->get_formatter()->make_help(one, name, CLI::AppFormatMode::Normal));
  });
}

}  // namespace gearsweep
