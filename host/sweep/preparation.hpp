// All that a sweep needs to begin: engines that work, a plan whose tiles fit them, and the
// certainty that the machine has room.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/engine.hpp"
#include "sweep/resource_estimate.hpp"
#include "sweep/sweep_options.hpp"
#include "workers/shard.hpp"

namespace gearsweep {

using Engines = std::vector<std::unique_ptr<Engine>>;

struct Preparation {
  Engines engines;
  std::optional<Plan> plan;  // there
  StudyNeeds needs;
};

// Throws InputError when the study cannot be planned or does not fit the machine, RunError when no
// device works. Writes nothing.
Preparation prepare_sweep(const Study& study, const SweepOptions& options, const Shard& shard = {});

// The plan with tiles of so many points, as a journal has them. Throws InputError when they do not
// fit the devices.
Plan plan_as_kept(const Study& study, std::size_t tile_points, const Engines& engines,
                  const SweepOptions& options);

}  // namespace gearsweep
