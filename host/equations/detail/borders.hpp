// Where the equations change their form with a state, found in their graph: at the borders of what
// chooses between two expressions. These are comparisons, abs, sign, min, max, floor and atan2;
// `backlash` and `stop` are contacts (contacts.hpp), which bend and never jump.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "equations/detail/formula.hpp"

namespace gearsweep {

// A place lhs = rhs with a state in it.
struct Border {
  NodeId lhs = 0, rhs = 0;
  // What each node that changes there is where lhs > rhs, and where lhs < rhs.
  std::map<NodeId, NodeId> above, below;
};

// All borders of these equations. An `==` has none: it holds for a moment only, if at all.
std::vector<Border> find_borders(Formula* formula, const std::vector<NodeId>& equations);

// The nodes, among what `roots` are made of, that any of `sources` changes.
std::set<NodeId> changed_by(const ExpressionGraph& graph, const std::vector<NodeId>& roots,
                            const std::set<NodeId>& sources);

std::set<NodeId> states_of(const Formula& formula);

// Whether a node is met only in sines, cosines and tangents, times numbers that make `jump` of it
// whole turns.
bool is_taken_in_turns(ExpressionGraph* graph, const std::vector<NodeId>& roots, NodeId id,
                       double jump);

}  // namespace gearsweep
