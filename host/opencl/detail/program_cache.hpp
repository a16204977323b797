// Built programs on disk, so that a run starts with what an earlier one has compiled.
#pragma once

#include <filesystem>
#include <string>

#include "opencl/detail/cl.hpp"

namespace gearsweep {

// Where programs for devices of this platform (its CL_PLATFORM_NAME) are kept; empty: nowhere. The
// environment's GEARSWEEP_CACHE_DIR decides when it is set (empty: nowhere), else it is gearsweep/
// in $XDG_CACHE_HOME or ~/.cache, unless the platform keeps compiled kernels itself.
std::filesystem::path program_cache_folder(const std::string& platform);

// The program of `source`: from `folder` when an earlier run left it there, else as build_program()
// gives it, and then kept. An entry that is damaged, or that the device refuses, is built again and
// replaced; a folder that cannot be used is none. Any number of processes may share a folder; it
// holds at most 64 programs, those that were used last. Throws as build_program() does.
cl::Program cached_program(const cl::Context& context, const cl::Device& device,
                           const std::string& source, const std::string& options,
                           const std::filesystem::path& folder);

}  // namespace gearsweep
