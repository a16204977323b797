// gearsweep tolerance: a page about gears as they are built.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/several_runs.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "report/tolerance_report.hpp"

namespace gearsweep {
namespace {

struct ToleranceArguments {
  std::string study, output, device;
  std::vector<std::string> overrides;
  ToleranceOptions options;
  bool restart = false, quiet = false;
};

std::string tolerance_command_line(const ToleranceArguments& arguments) {
  std::string line = "gearsweep tolerance " + shell_quoted(arguments.study);
  const ToleranceOptions& options = arguments.options;
  line += fmt::format(" --gears {} --class {} --percentile {}", options.gears,
                      options.tolerance_class, options.percentile);
  if (options.width) line += fmt::format(" --width {}", *options.width);
  for (const std::string& text : arguments.overrides) line += " --set " + shell_quoted(text);
  if (!arguments.output.empty()) line += " -o " + shell_quoted(arguments.output);
  return line;
}

// Files whose names begin so.
void remove_all_from(const std::string& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path);
  for (const auto& entry : std::filesystem::directory_iterator(whole.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(whole.filename().string())) std::filesystem::remove(entry.path());
  }
}

int run_tolerance(ToleranceArguments* arguments, SignalWatch* signals) {
  ToleranceOptions& options = arguments->options;
  if (arguments->output.empty() && options.json_path.empty()) {
    throw InputError("nothing would be written: give -o PAGE.html, --json FINDINGS.json or both");
  }
  const std::string& main_output =
      arguments->output.empty() ? options.json_path : arguments->output;
  const Study study = load_study(arguments->study, arguments->overrides);
  options.devices = chosen_devices(arguments->device);
  options.command_line = tolerance_command_line(*arguments);
  options.journal_path = main_output + ".journal";
  if (arguments->restart) remove_all_from(options.journal_path);
  return tell_several_runs(&options, main_output, arguments->quiet, signals, [&] {
    return write_tolerance_report(study, arguments->output, options);
  });
}

}  // namespace

void add_tolerance_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "tolerance",
      "A page about gears as built: bands over speed, lost contact, which tolerance matters");
  const auto arguments = std::make_shared<ToleranceArguments>();
  ToleranceOptions& options = arguments->options;
  add_study_argument(command, &arguments->study);
  command->add_option("-o,--output", arguments->output, "The page: .html or .pdf")
      ->type_name(kFileValue);
  command
      ->add_option("--json", options.json_path,
                   "Also the findings for programs, .json; without -o they alone")
      ->type_name(kFileValue);
  command->add_option("--gears", options.gears, "How many gears are drawn")
      ->check(CLI::Range(20, 100000))
      ->capture_default_str();
  command
      ->add_option("--class", options.tolerance_class,
                   "Of ISO 1328-1, for the flanks of a study without an [uncertain] table")
      ->check(CLI::Range(1, 11))
      ->capture_default_str();
  command
      ->add_option("--percentile", options.percentile,
                   "How many gears of 100 must be better than the value that is told")
      ->check(CLI::Range(50.5, 99.9))
      ->capture_default_str();
  command
      ->add_option("--width", options.width,
                   "Draw more gears (at most 100000) until that value is known to this share of "
                   "itself at the worst speed")
      ->check(CLI::Range(1e-4, 1.0));
  command
      ->add_option("--worst", options.worst_folder,
                   "A folder for the ten worst gears, as studies that run")
      ->type_name("FOLDER");
  command->add_option("--bands", options.bands_path, "A file for the maps over speed, .nc")
      ->type_name(kFileValue);
  add_set_option(command, &arguments->overrides);
  add_device_option(command, &arguments->device, true);
  command->add_flag("--restart", arguments->restart,
                    "Begin again, and not where an interrupted run has left off");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->footer(
      "Examples:\n"
      "  gearsweep gear new 19/61 --module 2.5 -o mine.toml\n"
      "  gearsweep tolerance mine.toml -o built.html\n"
      "  gearsweep tolerance mine.toml --class 5 --width 0.01 -o built.pdf\n"
      "  gearsweep tolerance mine.toml --gears 40000 --worst worst -o built.html\n"
      "  gearsweep tolerance mine.toml --json built.json\n\n"
      "The study needs one axis, a speed. What scatters is in its [uncertain] table; a study with\n"
      "a [gear] table that has none gets usual tolerances: flanks by ISO 1328-1, estimates of the\n"
      "rest, all listed on the page. Each gear is followed on the motion of the nominal one. A\n"
      "percentile stands with the half of its 95 % interval. An interrupted run goes on when it "
      "is\n"
      "started again.");
  command->callback(
      [arguments, signals, status] { *status = run_tolerance(arguments.get(), signals); });
}

}  // namespace gearsweep
