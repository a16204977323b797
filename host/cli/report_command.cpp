// gearsweep report: a page about a gear over speed.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/several_runs.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "report/report.hpp"

namespace gearsweep {
namespace {

struct ReportArguments {
  std::string study, output, device;
  std::vector<std::string> overrides;
  bool quiet = false;
};

std::string report_command_line(const ReportArguments& arguments) {
  std::string line = "gearsweep report " + shell_quoted(arguments.study);
  for (const std::string& text : arguments.overrides) line += " --set " + shell_quoted(text);
  return line + " -o " + shell_quoted(arguments.output);
}

int run_report(const ReportArguments& arguments, SignalWatch* signals) {
  const Study study = load_study(arguments.study, arguments.overrides);
  ReportOptions options;
  options.devices = chosen_devices(arguments.device);
  options.command_line = report_command_line(arguments);
  return tell_several_runs(&options, arguments.output, arguments.quiet, signals,
                           [&] { return write_report(study, arguments.output, options); });
}

}  // namespace

void add_report_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "report", "A page about a gear: data, critical speeds, forces, orders, run-up and run-down");
  const auto arguments = std::make_shared<ReportArguments>();
  add_study_argument(command, &arguments->study);
  command
      ->add_option("-o,--output", arguments->output,
                   "The report: .html, with its pictures in it; a browser prints it to PDF")
      ->type_name(kFileValue)
      ->required();
  add_set_option(command, &arguments->overrides);
  add_device_option(command, &arguments->device, true);
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->footer(
      "Examples:\n"
      "  gearsweep report table1-gear -o report.html\n"
      "  gearsweep report mine.toml -o short.html --set axes.omega.count=80\n\n"
      "The study needs an axis that is a speed: omega, or a speed of its [gear] table. Of a "
      "second\n"
      "axis there are maps; curves are at the value that the study has without that axis. With a\n"
      "[gear] table all is in rpm, Hz, N and um. What the study observes does not matter: the\n"
      "report takes what its model has of forces, contact and vibration.");
  command->callback([arguments, signals, status] { *status = run_report(*arguments, signals); });
}

}  // namespace gearsweep
