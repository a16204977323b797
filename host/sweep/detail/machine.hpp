// What is left of this machine's memory and disk, in bytes.
#pragma once

#include <optional>
#include <string>

namespace gearsweep {

// For this process: what the system has, less where a control group or an address space limit
// (ulimit -v) gives less. Nothing where the system does not tell.
std::optional<double> available_memory();

// On the file system of this folder; nothing when it cannot be asked.
std::optional<double> available_disk(const std::string& folder);

}  // namespace gearsweep
