// Follows one point of a study in time.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/trace.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// study: of one point (every axis has one value), unless it is chained: then the axis that it goes
// along ends, in its direction, with the point.
//
// The trace begins where the sweep of that study begins to record the point and is as long as its
// record: same start, same steps, on the same device the same bits at phase 0 where the sweep
// integrates all states, which a trace always does. A point that stops on a periodic orbit repeats
// one turn of it, in the map and here. With samples_per_period = 0 its
// moments are both ends of all integration steps, so that a break phase stands there twice, with
// the values from either side; otherwise so many evenly spaced ones in each forcing period from
// phase 0 on,
// by cubic Hermite interpolation between the steps.
//
// It uses the first device and stop of `options`; nothing when stopped. Throws InputError, also
// for a trace that the machine's memory cannot hold, and RunError when the point diverges.
std::optional<Trace> run_trace(const Study& study, std::size_t samples_per_period,
                               const SweepOptions& options);

}  // namespace gearsweep
