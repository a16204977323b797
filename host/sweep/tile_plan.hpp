// How a study is cut into tiles: large enough to keep the engines busy, small enough for the
// machine and for an interruption to cost little.
#pragma once

#include <memory>
#include <vector>

#include "engine/engine.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

using Engines = std::vector<std::unique_ptr<Engine>>;

// Throws InputError when the study cannot be planned, or not even a tile of one point fits.
Plan plan_that_fits(const Study& study, const Engines& engines, const SweepOptions& options);

// The plan with tiles of so many points, as a journal has them. Throws InputError when they do not
// fit the devices.
Plan plan_as_kept(const Study& study, std::size_t tile_points, const Engines& engines,
                  const SweepOptions& options);

}  // namespace gearsweep
