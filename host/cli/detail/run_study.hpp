// What 'gearsweep run' does in the process that plans and writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sweep/sweep.hpp"

namespace gearsweep {

class SignalWatch;

struct RunArguments {
  std::string study, output, plot, quantity, shard;
  std::string devices;
  std::optional<std::size_t> lanes;
  std::vector<std::string> overrides;
  std::vector<std::string> zooms;  // "omega=1.5:1.9", one axis each
  bool restart = false;
  bool strict_device = false;
  bool keep_journal = false;
  bool quiet = false;
  bool as_json = false;
  bool dry_run = false;
};

// Tells of a trouble that the run survives, below its progress.
void warn(const std::string& what);

// With these devices, and the other processes of the cluster if there is one. The exit status;
// throws as run_sweep() does, and InputError where the arguments do not fit the study.
int run_study(const RunArguments& given, const std::vector<DeviceChoice>& devices, Cluster* cluster,
              SignalWatch* signals);

}  // namespace gearsweep
