// gearsweep report: a page about a gear over speed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
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
  std::string study, against, output, device;
  std::vector<std::string> overrides, other_overrides;
  bool quiet = false;

  bool compares() const { return !against.empty() || !other_overrides.empty(); }
};

std::string report_command_line(const ReportArguments& arguments) {
  std::string line = "gearsweep report " + shell_quoted(arguments.study);
  if (!arguments.against.empty()) line += " --against " + shell_quoted(arguments.against);
  for (const std::string& text : arguments.overrides) line += " --set " + shell_quoted(text);
  for (const std::string& text : arguments.other_overrides) {
    line += " --against-set " + shell_quoted(text);
  }
  return line + " -o " + shell_quoted(arguments.output);
}

// What the two are called: by their files, or where these are one by what the second has set.
void name_both(const ReportArguments& arguments, ReportStudies* studies) {
  const auto stem = [](const std::string& path) {
    return std::filesystem::path(path).stem().string();
  };
  std::string first = stem(arguments.study);
  std::string second = arguments.against.empty() ? first : stem(arguments.against);
  if (first == second && arguments.other_overrides.empty()) {
    first = arguments.study;
    second = arguments.against;
  }
  if (first == second) {
    second = fmt::format("{}, {}", second, fmt::join(arguments.other_overrides, ", "));
  }
  (*studies)[0].name = first;
  (*studies)[1].name = second;
}

ReportStudies studies_of(const ReportArguments& arguments) {
  ReportStudies studies = {{load_study(arguments.study, arguments.overrides), ""}};
  if (!arguments.compares()) return studies;
  std::vector<std::string> overrides = arguments.overrides;
  overrides.insert(overrides.end(), arguments.other_overrides.begin(),
                   arguments.other_overrides.end());
  studies.push_back(
      {load_study(arguments.against.empty() ? arguments.study : arguments.against, overrides), ""});
  name_both(arguments, &studies);
  return studies;
}

int run_report(const ReportArguments& arguments, SignalWatch* signals) {
  const ReportStudies studies = studies_of(arguments);
  ReportOptions options;
  options.devices = chosen_devices(arguments.device);
  options.command_line = report_command_line(arguments);
  return tell_several_runs(&options, arguments.output, arguments.quiet, signals,
                           [&] { return write_report(studies, arguments.output, options); });
}

}  // namespace

void add_report_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "report", "A page about a gear: data, critical speeds, forces, orders, run-up and run-down");
  const auto arguments = std::make_shared<ReportArguments>();
  add_study_argument(command, &arguments->study);
  command
      ->add_option("-o,--output", arguments->output,
                   "The report: .html, with its pictures in it, or .pdf, which Chromium prints")
      ->type_name(kFileValue)
      ->required();
  command
      ->add_option("--against", arguments->against,
                   "Another study, side by side with this one: same pictures, same axes, and what "
                   "differs")
      ->type_name(kStudyValue);
  command
      ->add_option(
          "--against-set", arguments->other_overrides,
          "As --set, of the other study alone; without --against that is this one, changed")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  add_set_option(command, &arguments->overrides);
  add_device_option(command, &arguments->device, true);
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->footer(
      "Examples:\n"
      "  gearsweep report table1-gear -o report.html\n"
      "  gearsweep report mine.toml -o report.pdf --set axes.omega.count=80\n"
      "  gearsweep report sound.toml --against cracked.toml -o both.pdf\n"
      "  gearsweep report sound.toml --against-set 'gear.damage=[0.3, 0]' -o both.html\n\n"
      "The study needs an axis that is a speed: omega, or a speed of its [gear] table; or its\n"
      "points are a load spectrum, and the page has the answer over all loads. Of a second\n"
      "axis there are maps; curves are at the value that the study has without that axis. With a\n"
      "[gear] table all is in rpm, Hz, N and um. What the study observes does not matter: the\n"
      "report takes what its model has of forces, contact and vibration.");
  command->callback([arguments, signals, status] { *status = run_report(*arguments, signals); });
}

}  // namespace gearsweep
