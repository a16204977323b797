#include "cli/run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/detail/arguments.hpp"
#include "cli/standard_streams.hpp"
#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "plot/plot.hpp"
#include "result/broken_file.hpp"
#include "result/result_file.hpp"
#include "result/result_size.hpp"
#include "result/study_source.hpp"
#include "result/trace_file.hpp"

namespace gearsweep {
namespace {

// The command as it would be typed again, to go on where it was interrupted.
std::string command_line(const RunRequest& request, const std::string& output) {
  std::string line =
      fmt::format("gearsweep run {} -o {}", shell_quoted(request.study), shell_quoted(output));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {} {}", option, shell_quoted(value));
  };
  const auto add_flag = [&](const char* option, bool is_given) {
    if (is_given) line += fmt::format(" {}", option);
  };
  if (!request.devices.empty()) line += fmt::format(" --device {}", request.devices);
  if (!request.shard.empty()) line += fmt::format(" --shard {}", request.shard);
  for (const std::string& assignment : request.overrides) add("--set", assignment);
  for (const std::string& zoom : request.zooms) add("--zoom", zoom);
  add("--plot", request.plot);
  add("-q", request.quantity);
  add_flag("--strict-device", request.strict_device);
  add_flag("--keep-journal", request.keep_journal);
  add_flag("--quiet", request.quiet);
  add_flag("--json", request.as_json);
  return line;
}

// What stands in the way of a result of this study; empty: nothing that would be missed.
std::string what_is_lost(const std::string& path, const Study& study) {
  if (!is_netcdf(path)) return "";
  try {
    ensure_not_broken(path);
    if (is_trace_file(path)) return "traces";
    if (read_result_study(path).toml == study.toml) return "";
    const std::string title = ResultFile(path).title();
    return "the result of another study" + (title.empty() ? "" : fmt::format(", '{}'", title));
  } catch (const std::exception&) {
    return "what is no whole result of 'gearsweep run'";
  }
}

// Without -o the name of the study, of a zoom another one.
std::string output_path(const RunRequest& request) {
  std::string path = request.output;
  if (path.empty()) {
    path = std::filesystem::path(request.study).stem().string();
    path += request.zooms.empty() ? ".nc" : "-zoom.nc";
  }
  refuse_own_output(request.study, path);
  require_result_path(path);
  return path;
}

// An earlier zoom must not be lost to a name that nobody gave; what was named is told of.
void guard_replaced(const RunRequest& request, const Study& study, const std::string& output) {
  if (!request.shard.empty() || request.dry_run) return;
  const std::string lost = what_is_lost(output, study);
  if (lost.empty()) return;
  if (request.output.empty() && !request.zooms.empty()) {
    throw InputError(fmt::format("{}: holds {}; give another output, -o OUT.nc", output, lost));
  }
  tell("gearsweep: warning: {} holds {}; this run will replace it\n", output, lost);
}

// A quantity to plot must be one that the study computes.
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

// A shard's journal is its result.
std::string journal_path(const RunRequest& request, const std::string& output) {
  if (request.shard.empty()) return output + ".journal";
  const Shard shard = parse_shard(request.shard);
  return fmt::format("{}.shard-{}-of-{}.journal", output, shard.number, shard.count);
}

}  // namespace

RunOutput::RunOutput(const RunRequest& request, const Study& study)
    : request_(request), path_(output_path(request)) {
  ensure_writable(path_);
  if (!request.quantity.empty()) check_quantity(study, request.quantity);
  if (!request.plot.empty()) ensure_plottable(request.plot);
  guard_replaced(request, study, path_);
  journal_ = journal_path(request, path_);
  command_ = command_line(request, path_);
  const ResultSize size = size_of_result(study, provenance());
  delivery_ = {size.file, size.memory};
}

Provenance RunOutput::provenance() const { return {command_, version(), source_hash()}; }

SweepOptions RunOutput::sweep_options() const {
  SweepOptions options;
  options.devices = request_.chosen_devices;
  options.cluster = request_.cluster;
  if (!request_.shard.empty()) options.shard = parse_shard(request_.shard);
  options.journal_path = journal_;
  options.strict_device = request_.strict_device;
  options.keep_journal = request_.keep_journal;
  options.notes = {{notes::kCommand, command_}};
  options.delivery = delivery_;
  return options;
}

void RunOutput::discard_journal() const { Journal::discard(journal_); }

void RunOutput::write(const SweepResult& result) const {
  discard_abandoned(path_);  // the journal's lock keeps other runs away
  write_result(result, path_, provenance());
}

void RunOutput::plot() const {
  PlotRequest plot;
  plot.paths = {path_};
  plot.quantity = request_.quantity;
  plot.output_path = request_.plot;
  plot_files(plot);
}

}  // namespace gearsweep
