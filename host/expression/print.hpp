// A node as text that parse_expression() reads as the same node.
#pragma once

#include <string>

#include "expression/expression.hpp"

namespace gearsweep {

std::string to_text(const ExpressionGraph& graph, NodeId id);

// The same for a reader, in one line; of what is long, only how long it is. Of the name of a table
// it has the characters that can neither end a comment of C nor steer a terminal, and _ for others.
std::string to_short_text(const ExpressionGraph& graph, NodeId id);

}  // namespace gearsweep
