// What a sweep will take, told without running it.
#pragma once

#include "sweep/resource_estimate.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct Forecast {
  Study study;  // with the step that it has
  std::size_t points = 0, trajectories = 0;
  std::size_t tile_points = 0, tiles = 0;
  double steps = 0.0;                   // planned, without stops on orbits and longer windows
  double seconds = 0.0;                 // about
  std::size_t sample = 0;               // points that were run to measure that
  bool has_whole_sample = false;        // they were run to their end, not only for a moment
  std::vector<std::string> integrated;  // the states that will be (plan/passive_states.hpp)
  std::size_t states = 0;               // of the model
  std::optional<PilotFindings> pilot;
  ResourceEstimate estimate;
};

// Runs a thin sample of the study for a second or two on each device; of a study with a tolerance,
// its pilot before. Writes nothing. Throws what run_sweep would throw; nothing when options.stop
// was set.
std::optional<Forecast> forecast_sweep(const Study& study, const SweepOptions& options);

}  // namespace gearsweep
