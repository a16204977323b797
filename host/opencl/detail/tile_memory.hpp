// How much memory a tile takes on a device (buffer_plan.hpp, and what launcher.cpp uploads of its
// inputs) and beside it.
#pragma once

#include <cstddef>

#include "engine/engine.hpp"

namespace gearsweep {

// How numbers lie in a device's buffers.
struct BufferLayout {
  std::size_t lanes = 1, scalar_bytes = 8;
};

// Upper bounds: how many points come to an orbit, and how long it is, shows only when they run.
TileMemory max_of_tile(const Plan& plan, const Tile& tile, const BufferLayout& layout);

}  // namespace gearsweep
