// Computes one tile: settles it, stops the points that arrive on a periodic orbit, records the
// others, and goes on with those whose kind of motion could not be told.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

struct TileCallbacks {
  RoundCallback after_round;
  std::function<void(double steps)> on_work;  // so many steps more than planned (fewer: negative)
};

// initial: [point of the tile][state]. Of the cost, only the number of points that stopped early
// is set. Nothing when the callback asked to stop. Throws RunError.
std::optional<TileResult> run_tile(const Plan& plan, const Tile& tile,
                                   const std::vector<double>& initial, Engine* engine,
                                   const TileCallbacks& callbacks);

}  // namespace gearsweep
