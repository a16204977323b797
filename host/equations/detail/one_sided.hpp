// Expressions of the phase at a break, as the limit from one side.
#pragma once

#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// The values with two phases in them: `phase`, which may be at a break (phase_breaks.hpp), and
// `inside`, a symbol for a phase between that break and the next one on the side that is wanted.
std::vector<NodeId> one_sided(ExpressionGraph* graph, NodeId phase, NodeId inside,
                              const std::vector<NodeId>& values);

}  // namespace gearsweep
