// A report on a study over speed, as one page of HTML: the data, natural frequencies and critical
// speeds, forces and contact, worst speeds, the order map, run-up and run-down, what was assumed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "opencl/open_devices.hpp"
#include "study/study.hpp"

namespace gearsweep {

struct ReportOptions {
  std::vector<DeviceChoice> devices;  // the order map uses the first of them
  std::shared_ptr<OpenDevices> open = std::make_shared<OpenDevices>();  // as SweepOptions::open
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> on_step;  // what is done next
  std::string command_line;
};

// Throws InputError unless the study has an axis that is a speed, that is, changes the period of
// the forcing, and the report can be put there; RunError when gnuplot is not installed.
void ensure_report(const Study& study, const std::string& path);

// Runs what the report takes, and writes it, whole or not at all. Its pictures are in the page
// itself. False when stopped. Throws as ensure_report(), and RunError.
bool write_report(const Study& study, const std::string& path, const ReportOptions& options);

}  // namespace gearsweep
