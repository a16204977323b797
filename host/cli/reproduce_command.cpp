// gearsweep reproduce: the paper's figures and what they say.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/several_runs.hpp"
#include "reproduce/reproduce.hpp"

namespace gearsweep {
namespace {

struct ReproduceArguments {
  std::string preset = "paper", folder;
  std::string device;
  std::vector<std::string> overrides;
  bool quiet = false;
};

int run(const ReproduceArguments& arguments, SignalWatch* signals) {
  ReproduceOptions options;
  options.preset = arguments.preset;
  options.folder = arguments.folder;
  options.overrides = arguments.overrides;
  options.devices = chosen_devices(arguments.device);
  return tell_several_runs(&options, arguments.folder + "/report.md", arguments.quiet, signals,
                           [&] { return reproduce(options); });
}

}  // namespace

void add_reproduce_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "reproduce", "The figures of Chen et al. 2011, and a report on what the paper says of them");
  const auto arguments = std::make_shared<ReproduceArguments>();
  add_choice(command, "--preset", &arguments->preset, {"paper", "consistent"},
             "paper: the printed equations, fitted to the figures (default); consistent: the "
             "same questions to the consistent equations");
  command
      ->add_option("-o,--output", arguments->folder,
                   "The folder for report.md, pictures and results")
      ->type_name(kFolderValue)
      ->required();
  add_set_option(command, &arguments->overrides);
  add_device_option(command, &arguments->device, true);
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->footer(
      "Examples:\n"
      "  gearsweep reproduce -o paper\n"
      "  gearsweep reproduce --preset consistent -o consistent\n"
      "  gearsweep reproduce -o light --set parameters.F1=0.1    # parameters of your own\n\n"
      "The studies behind the figures are built in: gearsweep run paper/fig7 -o fig7.nc");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
