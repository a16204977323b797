// The maps of a grid of a scene's points.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct CellMaps {
  // [map][y][x]: the status of each point (kRefused: the study refuses it), then each quantity of
  // the scene's study, NaN where there is no value.
  std::vector<double> numbers;
  std::string refusal;  // why the first refused point is; empty: none is
  // What computed them, and which states were integrated, as SweepResult has it.
  EngineInfo engine;
  std::vector<std::string> integrated;
};

inline constexpr double kRefused = 255.0;

// What run_sweep() computes at these values of the axes; nothing when stopped. A point that the
// study refuses, such as one whose period would need too many steps, is no error. Throws RunError
// when no device works.
std::optional<CellMaps> compute_cells(const Scene& scene,
                                      const std::array<std::vector<double>, 2>& values,
                                      const SweepOptions& options);

}  // namespace gearsweep
