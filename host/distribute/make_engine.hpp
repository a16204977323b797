// The engine that a study asks for. Private to this folder.
#pragma once

#include <memory>
#include <optional>

#include "engine/engine.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

// Without a choice, the default device. Throws InputError or RunError.
std::unique_ptr<Engine> make_engine(const Study& study, std::optional<DeviceChoice> choice);

}  // namespace gearsweep
