// The engine that a study asks for. Private to this folder.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "engine/engine.hpp"

namespace gearsweep {

// device: of list_devices(); nothing: the default one. Throws InputError or RunError.
std::unique_ptr<Engine> make_engine(const Study& study, std::optional<std::size_t> device);

}  // namespace gearsweep
