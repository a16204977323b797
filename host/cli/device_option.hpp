// --device of every command that computes. Private to this folder.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "opencl/device.hpp"

namespace gearsweep {

// For a command that uses one device, or several.
void add_device_option(CLI::App* command, std::string* text, bool several);

// What parse_devices() makes of it; nothing for an empty text. Throws InputError.
std::vector<DeviceChoice> chosen_devices(const std::string& text);

}  // namespace gearsweep
