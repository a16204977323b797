// The paper's figures, computed, drawn, and held against what it says of them.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "opencl/open_devices.hpp"

namespace gearsweep {

struct ReproduceOptions {
  std::string preset;                  // "paper" or "consistent"
  std::string folder;                  // made when it is not there
  std::vector<std::string> overrides;  // of each study: "parameters.F1=0.1"
  std::vector<DeviceChoice> devices;   // empty: the default one
  std::shared_ptr<OpenDevices> open = std::make_shared<OpenDevices>();  // as SweepOptions::open
  std::function<void(const std::string&)> on_step;                      // what is being done now
  const std::atomic<bool>* stop = nullptr;
};

// Runs the built-in studies PRESET/fig4 .. PRESET/fig11 and what the report adds to them, and
// writes into the folder each result, each picture, and report.md. False when `stop` was set.
// Throws InputError for a folder that will not do, RunError.
bool reproduce(const ReproduceOptions& options);

}  // namespace gearsweep
