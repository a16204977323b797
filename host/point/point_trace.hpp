// Time histories of single points of a study or of a map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "point/place.hpp"
#include "study/found_step.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// How long a trace settles and how long it is, in mesh periods. Nothing: as the study says.
struct TraceWindows {
  std::optional<std::size_t> settle, record;
};

// The study with traces that begin after exactly `settle` mesh periods, also where the point has
// settled on a periodic orbit before, and are `record` mesh periods long; both are rounded up to
// whole periods of the forcing, of which each may be many mesh periods.
Study with_windows(const Study& study, const TraceWindows& windows);

// Gives the study the step that its traces take, that of the sweep to a chain's point included.
// pilot_step: what the pilot run of the map that they are of has found; nothing: there was none.
// Throws InputError when the study asks for a tolerance and there is no such step.
void settle_step(const std::optional<FoundStep>& pilot_step, Study* study);

// Traces beside each other, as write_traces() takes them.
struct PointTraces {
  std::vector<Trace> traces;
  std::vector<std::string> labels;  // one for each
  std::vector<std::string> placed;  // the parameters that their places have
  // Places that could not be taken as they were (move_to_chain()), a line each.
  std::vector<std::string> notices;
};

// Follows the point of `whole` at `place`, which need be no point of its axes, and adds its trace.
// whole has these windows; a place with other mesh periods in its forcing period keeps the mesh
// periods. samples_per_period: in a mesh period, evenly spaced; 0: both ends of each step. False
// when `options.stop` was set. The study's step is settled. Throws InputError, and RunError when
// the point diverges.
bool add_point_trace(const Study& whole, Place place, const TraceWindows& windows,
                     std::size_t samples_per_period, const SweepOptions& options, PointTraces* out);

}  // namespace gearsweep
