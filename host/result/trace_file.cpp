#include "result/trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/error.hpp"
#include "result/detail/csv_text.hpp"
#include "result/detail/dataset_file.hpp"
#include "result/detail/file_names.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/output_file.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxTraces = 10'000;  // of a file; a picture takes far fewer

// A unit in a table: what its numbers are multiplied by, and what it is called.
SiUnit unit_in_table(const std::string& unit, const Study& study, TableUnits units) {
  if (units == TableUnits::model) return {1.0, unit};
  const SiUnit si = shown_unit(unit, study.scales);
  return si.scale > 0.0 ? si : SiUnit{1.0, unit};
}

std::string csv_of(const std::vector<Trace>& traces, const std::vector<std::string>& placed,
                   const Study& study, TableUnits units) {
  const auto unit_of = [&](const std::string& unit) { return unit_in_table(unit, study, units); };
  CsvText csv;
  csv.add_name("trace");
  std::vector<SiUnit> placed_units, channel_units;
  std::vector<std::size_t> parameters;
  for (const std::string& name : placed) {
    parameters.push_back(static_cast<std::size_t>(study.model->find_parameter(name)));
    placed_units.push_back(unit_of(study.model->parameters[parameters.back()].unit));
    csv.add_name(name_in_traces(name, traces.front().channels), placed_units.back().name);
  }
  const SiUnit time = unit_of(time_unit(*study.model));
  csv.add_name("tau", time.name);
  for (const ChannelInfo& channel : traces.front().channels) {
    channel_units.push_back(unit_of(channel.unit));
    csv.add_name(channel.name, channel_units.back().name);
  }
  csv.end_row();
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const Trace& trace = traces[i];
    for (std::size_t moment = 0; moment < trace.tau.size(); ++moment) {
      csv.add_number(static_cast<double>(i + 1));
      for (std::size_t j = 0; j < placed.size(); ++j) {
        csv.add_number(placed_units[j].scale * trace.setting.parameters[parameters[j]]);
      }
      csv.add_number(time.scale * trace.tau[moment]);
      for (std::size_t j = 0; j < trace.values.size(); ++j) {
        csv.add_number(channel_units[j].scale * trace.values[j][moment]);
      }
      csv.end_row();
    }
  }
  return csv.text();
}

}  // namespace

void ensure_trace_file(const std::string& path, const Study& study, TableUnits units) {
  const bool is_table = path.ends_with(".csv");
  if (!is_table && !path.ends_with(".nc")) {
    throw InputError(
        fmt::format("cannot write traces to '{}': its name must end in .nc or .csv", path));
  }
  if (units == TableUnits::model) return;
  if (!is_table) {
    throw InputError(fmt::format(
        "--units SI is for tables: '{}' will have scale_to_SI beside each variable", path));
  }
  if (!study.scales.known()) {
    throw InputError("--units SI: the study has no [gear] table, which gives the scales");
  }
}

void write_traces(const std::vector<Trace>& traces, const std::vector<std::string>& labels,
                  const std::vector<std::string>& placed, const Study& study,
                  const std::string& path, const Provenance& provenance, TableUnits units) {
  ensure_trace_file(path, study, units);
  if (path.ends_with(".csv")) {
    write_file(path, csv_of(traces, placed, study, units));
    return;
  }
  write_dataset(dataset_of(traces, labels, placed, study, provenance), path);
}

bool is_trace_file(const std::string& path) {
  if (!is_netcdf(path)) return false;
  return NetcdfFile::open(path).text_attribute(NC_GLOBAL, "content") == kContentOfTraces;
}

namespace {

[[noreturn]] void refuse_foreign(const std::string& path) {
  throw InputError(
      fmt::format("'{}' holds no traces; give a file that 'gearsweep trace' wrote", path));
}

// Time begins somewhere and goes on; a trace ends where it is missing.
bool is_time(const std::vector<double>& tau) {
  return !tau.empty() &&
         std::adjacent_find(tau.begin(), tau.end(), std::greater<>()) == tau.end() &&
         std::isfinite(tau.front()) && std::isfinite(tau.back());
}

// Trace i: its time, and the channels that stand over the same dimensions as `tau`.
Trace read_trace(const NetcdfFile& file, int tau, std::size_t i) {
  const std::vector<int> dimensions = file.dimensions_of(tau);
  const std::size_t moments = file.dimension_size(dimensions[1]);
  Trace trace;
  trace.tau = file.read(tau, {i, 0}, {1, moments});
  const auto end = std::find_if(trace.tau.begin(), trace.tau.end(),
                                [](double time) { return std::isnan(time); });
  trace.tau.erase(end, trace.tau.end());
  for (const std::string& name : file.variables()) {
    const int variable = file.find_variable(name);
    if (name == "tau" || file.dimensions_of(variable) != dimensions) continue;
    trace.channels.push_back({name, file.text_attribute(variable, "units").value_or(""),
                              file.text_attribute(variable, "long_name").value_or(""),
                              role_of(file.text_attribute(variable, kRole).value_or("")),
                              file.text_attribute(variable, kVelocity).value_or("")});
    trace.values.push_back(file.read(variable, {i, 0}, {1, moments}));
    trace.values.back().resize(trace.tau.size());
  }
  return trace;
}

}  // namespace

std::vector<StoredTrace> read_traces(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  const int tau = file.find_variable("tau");
  const int label = file.find_variable("label");
  const int period = file.find_variable("period");
  const int mesh = file.find_variable(kMeshPeriods);
  const int clockless = file.find_variable(kClockless);
  if (file.text_attribute(NC_GLOBAL, "content") != kContentOfTraces || tau < 0 || label < 0 ||
      period < 0 || file.dimensions_of(tau).size() != 2) {
    refuse_foreign(path);
  }
  const std::size_t count = file.dimension_size(file.dimensions_of(tau).front());
  const std::vector<std::string> labels = file.read_texts(label);
  const std::vector<double> periods = file.read(period, {0}, {count});
  if (count == 0 || count > kMaxTraces || labels.size() != count) refuse_foreign(path);
  std::vector<StoredTrace> out;
  for (std::size_t i = 0; i < count; ++i) {
    StoredTrace stored;
    stored.title = file.text_attribute(NC_GLOBAL, "title").value_or("");
    stored.settings = file.text_attribute(NC_GLOBAL, "settings").value_or("");
    stored.label = labels[i];
    stored.scales = read_scales(file);
    stored.meshes = read_meshes(file);
    stored.trace = read_trace(file, tau, i);
    stored.trace.period = periods[i];
    stored.trace.is_clockless = clockless >= 0 && file.read(clockless, {i}, {1}).front() == 1.0;
    if (mesh >= 0) stored.trace.mesh_periods = file.read(mesh, {i}, {1}).front();
    if (!is_time(stored.trace.tau) || stored.trace.channels.empty() ||
        !(std::isfinite(periods[i]) && periods[i] > 0.0)) {
      refuse_foreign(path);
    }
    out.push_back(std::move(stored));
  }
  return out;
}

}  // namespace gearsweep
