// The product's engine: OpenCL work-items, LANES points each.
#pragma once

#include <memory>
#include <optional>

#include "engine/engine.hpp"
#include "opencl/open_devices.hpp"

namespace gearsweep {

// Without a choice, default_device(). open: where it is opened, once. Throws InputError for an
// unknown device or one that lacks fp64 when the study asks for it, RunError when the build fails
// or the device cannot be cut.
std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<DeviceChoice> choice,
                                           OpenDevices* open);
// On a device that it opens for itself.
std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<DeviceChoice> choice);

}  // namespace gearsweep
