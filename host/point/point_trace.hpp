// Time histories of single points of a study or of a map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "point/place.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// What a study is overridden with for traces that begin after exactly `settle` periods, also where
// the point has settled on a periodic orbit before, and are `record` periods long. Nothing: as the
// study says.
std::vector<std::string> trace_overrides(std::optional<std::size_t> settle,
                                         std::optional<std::size_t> record);

// Gives the study the step that its traces take, that of the sweep to a chain's point included.
// pilot_step: what the pilot run of the map that they are of has found; nothing: there was none.
// Throws InputError when the study asks for a tolerance and there is no such step.
void settle_step(std::optional<double> pilot_step, Study* study);

// Traces beside each other, as write_traces() takes them.
struct PointTraces {
  std::vector<Trace> traces;
  std::vector<std::string> labels;  // one for each
  std::vector<std::string> placed;  // the parameters that their places have
};

// Follows the point of `whole` at `place`, of a map the nearest of its points, and adds its trace.
// False when `options.stop` was set. The study's step is settled. Throws InputError, and RunError
// when the point diverges.
bool add_point_trace(const Study& whole, bool is_map, Place place, std::size_t samples_per_period,
                     const SweepOptions& options, PointTraces* out);

}  // namespace gearsweep
