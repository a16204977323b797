// Expressions as statements of OpenCL C.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// A place that a statement assigns to, and what.
using Assignment = std::pair<std::string, NodeId>;

// Statements in an order in which each uses earlier ones only. What is used more than once is
// worked out once. names: how symbols are written. All values are of type `real`.
std::string statements_of(const ExpressionGraph& graph, const std::vector<Assignment>& assignments,
                          const std::map<NodeId, std::string>& names);

}  // namespace gearsweep
