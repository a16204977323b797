// gearsweep completion, gearsweep manual: what the shell and man want to know of the commands.
#include <fmt/format.h>

#include <memory>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/completion.hpp"
#include "cli/manual.hpp"
#include "cli/standard_streams.hpp"

namespace gearsweep {

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
    if (*shell == "zsh") answer("autoload -U bashcompinit\nbashcompinit\n");
    answer("{}", *shell == "fish" ? fish_completion(table) : bash_completion(table));
  });
}

void add_manual_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("manual", "Print the manual page");
  command->footer("Example: gearsweep manual | man -l -");
  command->callback([app] { answer("{}", manual_page(command_table(*app))); });
}

}  // namespace gearsweep
