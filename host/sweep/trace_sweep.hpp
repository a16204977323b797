// Follows all points of a study in time, each from where its sweep has ended.
#pragma once

#include <cstddef>
#include <functional>

#include "engine/trace.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// Takes the history of a point; null where it has diverged.
using TakeTrace = std::function<void(std::size_t point, const Trace* trace)>;

// The sweep settles all points together, as the study's policy says: `settle` periods, or fewer
// where the motion is periodic before. Then each is followed for `record` periods more, with so
// many evenly spaced moments in each forcing period (see run_trace()), and is shown to `take`, in
// the order of the points. One trace at a time is held. The study's step is settled.
//
// It uses the first device and stop of `options`; false when stopped. Throws InputError and
// RunError.
bool sweep_traces(const Study& study, std::size_t samples_per_period, const SweepOptions& options,
                  const TakeTrace& take);

}  // namespace gearsweep
