// The maps of a grid of a scene's points.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// [map][y][x]: the status of each point, then each quantity of the scene's study, NaN where there
// is no value. What run_sweep() computes at these values of the axes; nothing when stopped. Throws
// as run_sweep() does.
std::optional<std::vector<double>> compute_cells(const Scene& scene,
                                                 const std::array<std::vector<double>, 2>& values,
                                                 const SweepOptions& options);

}  // namespace gearsweep
