// The second opinion: a plain engine in Eigen and double, points over threads.
#pragma once

#include <memory>

#include "engine/engine.hpp"

namespace gearsweep {

std::unique_ptr<Engine> make_reference_engine();

}  // namespace gearsweep
