// From the states that an engine gives at the ends of steps to a trace.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/trace.hpp"
#include "plan/plan.hpp"

namespace gearsweep {

// rows: as Engine::rows() gives them; samples_per_period: as for run_trace().
Trace trace_of(const Plan& plan, std::size_t point, const std::vector<double>& rows,
               std::size_t samples_per_period);

}  // namespace gearsweep
