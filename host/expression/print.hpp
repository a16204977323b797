// A node as text that parse_expression() reads as the same node.
#pragma once

#include <map>
#include <string>

#include "expression/expression.hpp"

namespace gearsweep {

std::string to_text(const ExpressionGraph& graph, NodeId id);

// Names of constants, by the nodes that they stand for.
using NodeNames = std::map<NodeId, std::string>;

// The same for a reader, in one line, who knows these names; of what is long, only how long it is.
// It has of the name of a table the characters that can neither end a comment of C nor steer a
// terminal, and _ for others.
std::string to_short_text(const ExpressionGraph& graph, NodeId id, const NodeNames& names = {});

}  // namespace gearsweep
