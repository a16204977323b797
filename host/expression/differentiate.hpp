// Exact derivatives. Where an expression has a corner, the derivative is that of the side that it
// takes.
#pragma once

#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// d(node)/d(argument) for each argument of the node, with all of them held apart; 0 of conditions.
std::vector<NodeId> partial_derivatives(ExpressionGraph* graph, NodeId id);

// d(of)/d(by), by: any node, taken as a variable of its own.
NodeId derivative(ExpressionGraph* graph, NodeId of, NodeId by);

// The same along a direction: the sum of the derivatives by symbols, times what these change by.
NodeId derivative_along(ExpressionGraph* graph, NodeId id, const std::vector<NodeId>& symbols,
                        const std::vector<NodeId>& by);

}  // namespace gearsweep
