// gearsweep run: from a study to finished maps.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/progress_bar.hpp"
#include "cli/signal_watch.hpp"
#include "cli/study_source.hpp"
#include "cli/summary.hpp"
#include "io/plot.hpp"
#include "io/result_file.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

struct RunArguments {
  std::string study, output, plot, quantity;
  std::optional<std::size_t> device;
  std::optional<std::size_t> lanes;
  std::vector<std::string> overrides;
  bool restart = false;
  bool quiet = false;
  bool as_json = false;
};

// The command as it would be typed again.
std::string command_line(const RunArguments& arguments, const std::string& output) {
  std::string line = fmt::format("gearsweep run '{}' -o '{}'", arguments.study, output);
  if (arguments.device) line += fmt::format(" --device {}", *arguments.device);
  for (const std::string& assignment : arguments.overrides) {
    line += fmt::format(" --set '{}'", assignment);
  }
  return line;
}

std::string output_path(const RunArguments& arguments) {
  std::string path = arguments.output;
  if (path.empty()) path = std::filesystem::path(arguments.study).stem().string() + ".nc";
  std::error_code error;
  if (std::filesystem::equivalent(path, arguments.study, error)) {
    throw InputError(
        fmt::format("{}: the result would replace its own study; give another output: "
                    "-o OUT.nc",
                    arguments.study));
  }
  if (std::filesystem::is_regular_file(path, error) && !is_netcdf(path)) {
    throw InputError(
        fmt::format("{}: exists and is no result file; it would be lost: give another "
                    "output, -o OUT.nc",
                    path));
  }
  return path;
}

// A quantity to draw must be one that the study computes.
void check_quantity(const Study& study, const std::string& quantity) {
  const std::string name = quantity.substr(0, quantity.find(':'));
  std::vector<std::string> known = {"status"};
  for (const Quantity& candidate : study.selection.quantities) known.push_back(candidate.name);
  if (!study.selection.poincare.empty()) known.push_back("poincare");
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw InputError(
        fmt::format("-q {}: the study does not compute it{}", quantity, suggest_name(name, known)));
  }
}

// Deletes the journal of an interrupted run.
void discard_journal(const std::string& journal) {
  for (const char* suffix : {"-journal", ""}) std::filesystem::remove(journal + suffix);
}

void warn_of_diverged(const SweepResult& result) {
  bool any_ok = false;
  for (const std::uint8_t status : result.status) any_ok = any_ok || status == 0;
  if (!any_ok) fmt::print(stderr, "gearsweep: warning: every point diverged; the maps are empty\n");
}

int run(const RunArguments& given) {
  RunArguments arguments = given;
  if (arguments.lanes) {
    arguments.overrides.push_back(fmt::format("integrate.lanes={}", *arguments.lanes));
  }
  const Study study = load_study(arguments.study, arguments.overrides);
  const std::string output = output_path(arguments);
  const std::string journal = output + ".journal";
  ensure_writable(output);
  if (!arguments.quantity.empty()) check_quantity(study, arguments.quantity);
  if (!arguments.plot.empty()) ensure_plottable(arguments.plot);
  if (arguments.restart) discard_journal(journal);

  const SignalWatch signals;
  ProgressBar bar;
  double kept = 0.0;
  SweepOptions options;
  options.device = arguments.device;
  options.journal_path = journal;
  options.stop = &signals.interrupted();
  options.on_progress = [&](const SweepProgress& progress) {
    kept = progress.share_kept;
    if (!arguments.quiet) bar.show(progress);
  };
  options.deliver = [&](const SweepResult& result) {
    write_result(result, output, {command_line(arguments, output), version(), source_hash()});
  };
  const std::optional<SweepResult> result = run_sweep(study, options);
  bar.close();
  if (!result) {
    if (kept == 0.0) {
      fmt::print(stderr, "gearsweep: interrupted before anything was finished\n");
    } else {
      fmt::print(stderr,
                 "gearsweep: interrupted; {:.0f} % are finished and kept in {}: the same "
                 "command continues from there\n",
                 100.0 * kept, journal);
    }
    return kInterrupted;
  }
  warn_of_diverged(*result);
  if (arguments.as_json) fmt::print("{}", run_as_json(*result, output));
  if (!arguments.quiet) fmt::print(stderr, "{}", describe_run(*result, output));
  if (!arguments.plot.empty()) {
    PlotRequest request;
    request.paths = {output};
    request.quantity = arguments.quantity;
    request.output_path = arguments.plot;
    plot_files(request);
    if (!arguments.quiet) fmt::print(stderr, "{}\n", arguments.plot);
  }
  return kDone;
}

}  // namespace

void add_run_command(CLI::App* app, int* status) {
  CLI::App* command = app->add_subcommand("run", "Compute the maps of a study");
  const auto arguments = std::make_shared<RunArguments>();
  command
      ->add_option("study", arguments->study,
                   "A study file, a built-in study, or a result file to compute again")
      ->type_name(kStudyValue)
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The result file (default: the study's name with .nc)")
      ->type_name(kFileValue)
      ->check([](const std::string& path) { return path.empty() ? "must not be empty" : ""; });
  CLI::Option* plot =
      command->add_option("--plot", arguments->plot, "Also draw a picture: .png, .svg or .pdf")
          ->type_name(kFileValue);
  command
      ->add_option(
          "-q,--quantity", arguments->quantity,
          "The quantity to draw (default: on one axis the samples, if there are any, else the "
          "study's first)")
      ->type_name(kQuantityValue)
      ->needs(plot);
  add_device_option(command, &arguments->device);
  command
      ->add_option("--lanes", arguments->lanes,
                   "Points per work-item: 1, 2, 4, 8 or 16 (default: what suits the device)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 16));
  add_set_option(command, &arguments->overrides);
  command->add_flag("--restart", arguments->restart,
                    "Start afresh: discard what an interrupted run left in OUT.nc.journal");
  command->add_flag("--quiet", arguments->quiet, "No progress and no summary");
  command->add_flag("--json", arguments->as_json, "Print the summary as JSON");
  command->footer(
      "Examples:\n"
      "  gearsweep run coarse-map -o map.nc --plot map.png\n"
      "  gearsweep run mine.toml --set parameters.mu=0 --set axes.omega.count=100\n"
      "  gearsweep run mine.toml --set model.backlash=dynamic --set integrate.record=20\n"
      "  gearsweep run map.nc -o again.nc           compute a result again, from itself\n\n"
      "An interrupted run (Ctrl-C, SIGTERM, kill -9, power cut) keeps what is finished in\n"
      "OUT.nc.journal; the same command continues from there.");
  command->callback([arguments, status] { *status = run(*arguments); });
}

}  // namespace gearsweep
