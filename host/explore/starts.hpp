// Where other starts lead at one point of a scene.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct ReachedAttractor {
  double share = 0.0;  // of the starts
  std::string name;    // "periodic, period 2, rms of x1 0.4123, at its section 0.3 on average"
  // [sample][state] of one of its motions, as Scene::sampled_at() takes them.
  std::vector<std::vector<double>> section;
};

struct ReachedAttractors {
  std::vector<ReachedAttractor> attractors;  // the one that most starts come to first
  double undecided = 0.0, diverged = 0.0;    // shares of the starts
};

// Follows the study's own start at the cell and seeded random ones in a box around it, which
// reaches as far to either side as the motion from that start goes from end to end,
// and tells the attractors apart that they come to (attractors/). starts: 2 or more. Nothing when
// stopped. Throws InputError and RunError.
std::optional<ReachedAttractors> look_at_starts(const Scene& scene, const Cell& cell,
                                                std::size_t starts, const SweepOptions& options);

}  // namespace gearsweep
