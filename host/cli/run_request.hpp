// What is asked of 'gearsweep run', and by what means it runs.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "study/study.hpp"

namespace gearsweep {

class Cluster;
class SignalWatch;

struct RunRequest {
  std::string study, output, plot, quantity, shard;
  std::string devices;
  std::vector<std::string> overrides;
  std::vector<std::string> zooms;  // "omega=1.5:1.9", one axis each
  bool restart = false;
  bool strict_device = false;
  bool keep_journal = false;
  bool quiet = false;
  bool as_json = false;
  bool dry_run = false;

  // Not from the command line:
  std::vector<DeviceChoice> chosen_devices;
  Cluster* cluster = nullptr;  // whose rank 0 this process is, if there is one
  SignalWatch* signals = nullptr;
};

// The run: from a study to its maps. Its exit status. Throws InputError and RunError.
using Run = std::function<int(const RunRequest&)>;

// The study as it is asked for. Throws InputError.
Study requested_study(const RunRequest& request);

}  // namespace gearsweep
