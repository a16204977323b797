#include "cli/cli.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/kernel_cache.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// "0 done", ...
std::vector<std::string> exit_statuses() {
  std::vector<std::string> texts;
  for (const auto& [status, meaning] : exit_meanings()) {
    texts.push_back(fmt::format("{} {}", status, meaning));
  }
  return texts;
}

void add_commands(CLI::App* app, const Run& run, SignalWatch* signals, int* status) {
  app->set_version_flag("--version", "gearsweep " + version());
  app->require_subcommand(1);
  app->footer(std::string("A first map:\n"
                          "  gearsweep studies                          what is built in\n"
                          "  gearsweep run coarse-map -o map.nc --plot map.png\n"
                          "  gearsweep plot map.nc -q dmf_max -o dmf.png\n\n"
                          "'gearsweep COMMAND --help' shows each command with examples, 'gearsweep "
                          "manual study'\n(installed: 'man gearsweep-study') every key of a "
                          "study.\n") +
              fmt::format("Exit status: {}.", fmt::join(exit_statuses(), ", ")));
  add_run_command(app, run, signals, status);
  add_merge_command(app, status);
  add_slurm_command(app);
  add_status_command(app);
  add_trace_command(app);
  add_explore_command(app, signals, status);
  add_orders_command(app, signals, status);
  add_plot_command(app);
  add_export_command(app);
  add_top_command(app);
  add_floquet_command(app);
  add_curves_command(app, signals, status);
  add_report_command(app, signals, status);
  add_tolerance_command(app, signals, status);
  add_reproduce_command(app, signals, status);
  add_studies_command(app);
  add_model_command(app);
  add_gear_command(app);
  add_devices_command(app);
  add_kernels_command(app);
  add_verify_command(app, signals, status);
  add_bench_command(app, signals, status);
  add_completion_command(app);
  add_manual_command(app);
  add_help_command(app);
}

// The parser would only say that a command is missing.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), argv[1]) == known.end()) {
    throw InputError(fmt::format("unknown command '{}'{}", argv[1], suggest_name(argv[1], known)));
  }
}

// As the parser takes them, the last one first. "--title=" gives an empty text; the parser would
// take the next word for it.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> arguments;
  bool are_options = true;
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    are_options = are_options && word != "--";
    const bool is_empty = are_options && word.starts_with("--") && word.ends_with('=');
    if (is_empty) word.pop_back();
    arguments.push_back(std::move(word));
    if (is_empty) arguments.emplace_back();
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

// Runs the command that the arguments name; its exit status.
int dispatch(int argc, char** argv, const Run& run, SignalWatch* signals) {
  CLI::App app(
      "gearsweep: maps of gear dynamics and non-smooth oscillators from massively parallel "
      "parameter sweeps",
      "gearsweep");
  int status = kDone;
  add_commands(&app, run, signals, &status);
  refuse_unknown_command(app, argc, argv);
  try {
    app.parse(arguments_of(argc, argv));
  } catch (const CLI::ParseError& error) {
    // The parser's own codes tell help (0) from errors, which are all wrong input to us.
    if (error.get_exit_code() != 0) throw InputError(describe_parse_error(app, error));
    std::ostringstream help;
    const int code = app.exit(error, help, help);
    answer("{}", help.str());
    return code;
  }
  return status;
}

}  // namespace

int run_cli(int argc, char** argv, const Run& run) {
  try {
    KernelCache kernels;
    SignalWatch signals([&kernels] { kernels.remove(); });
    const int status = dispatch(argc, argv, run, &signals);
    flush_answers();
    return status;
  } catch (const InputError& error) {
    tell("gearsweep: {}\n", error.what());
    return kWrongInput;
  } catch (const std::system_error& error) {
    // Who reads no further has what was asked for.
    if (error.code() != std::errc::broken_pipe) tell("gearsweep: {}\n", error.what());
    return kFailed;
  } catch (const std::exception& error) {
    tell("gearsweep: {}\n", error.what());
    return kFailed;
  }
}

}  // namespace gearsweep
