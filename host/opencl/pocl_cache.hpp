// Where PoCL, the OpenCL driver for CPUs, keeps the kernels that it compiles. Where it cannot, it
// offers no device.
#pragma once

#include <filesystem>

namespace gearsweep {

// The folder that it takes from the environment; POCL_CACHE_DIR names another.
std::filesystem::path pocl_cache_folder();

// Whether files can be written in the folder, which need not be there yet.
bool can_write_in(const std::filesystem::path& folder);

}  // namespace gearsweep
