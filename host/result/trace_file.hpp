// Files of traces: NetCDF-4, or CSV to be read elsewhere.
#pragma once

#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "model/exciting_meshes.hpp"
#include "result/result_file.hpp"
#include "result/table_units.hpp"

namespace gearsweep {

// Throws InputError unless the name ends in .nc or .csv, or when such a file of the study cannot
// have these units.
void ensure_trace_file(const std::string& path, const Study& study, TableUnits units);

// Writes them whole or not at all. The end of `path` decides:
//   .nc   dimensions (trace, moment): tau and each channel, missing values beyond a trace's end;
//         (trace): label, period, settled, and the parameters named in `placed`. All traces have
//         the channels of the first.
//   .csv  a row per moment: trace (from 1), the parameters of `placed`, tau, the channels.
// labels: one for each trace, "omega=0.7, b=1". units: of a table; a NetCDF file always has the
// model's, with the scales beside them. Throws InputError for an ending or a place that will not
// do, or units that the study does not have; RunError when the disk fails.
void write_traces(const std::vector<Trace>& traces, const std::vector<std::string>& labels,
                  const std::vector<std::string>& placed, const Study& study,
                  const std::string& path, const Provenance& provenance,
                  TableUnits units = TableUnits::model);

// By what it says of itself; false when there is no such file.
bool is_trace_file(const std::string& path);

// A trace as a file holds it; the setting is left empty.
struct StoredTrace {
  std::string title;     // of the study
  std::string settings;  // every value that the study resolved to, as TOML
  std::string label;
  Scales scales;                     // of a study with a [gear] table
  std::vector<ExcitingMesh> meshes;  // that of the phase first
  Trace trace;
};

// Throws InputError when it is no file of traces, RunError when it cannot be read.
std::vector<StoredTrace> read_traces(const std::string& path);

}  // namespace gearsweep
