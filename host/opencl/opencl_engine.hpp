// The product's engine: OpenCL work-items, LANES points each.
#pragma once

#include <memory>
#include <optional>

#include "engine/engine.hpp"

namespace gearsweep {

// `device` is a number of list_devices(); nothing means default_device(). Throws InputError for an
// unknown device or one that lacks fp64 when the study asks for it, RunError when the build fails.
std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<std::size_t> device);

}  // namespace gearsweep
