// Nodes as linear forms of some symbols.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// Coefficients by symbol; none of them is the number 0. What is left without the symbols is not
// told.
using LinearForm = std::map<NodeId, NodeId>;

// [node]: nothing of one that is not shown to be linear in all the symbols together.
std::vector<std::optional<LinearForm>> linear_forms(ExpressionGraph* graph,
                                                    const std::vector<NodeId>& nodes,
                                                    const std::vector<NodeId>& symbols);

// Whether sums of products with numbers show that it is 0. Of what is 0 for another reason it may
// say no.
bool is_zero_sum(const ExpressionGraph& graph, NodeId id);

}  // namespace gearsweep
