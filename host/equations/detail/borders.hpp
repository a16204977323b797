// Where the equations bend or jump with a state, found in their graph: at the borders of what
// chooses between two expressions. These are comparisons, abs, sign, min, max, floor and atan2;
// `backlash` and `stop` are contacts (contacts.hpp), which bend and never jump.
#pragma once

#include <map>
#include <optional>
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

// The first equation that jumps at a border, that is, of which it cannot be shown that both sides
// are the same where lhs = rhs: by putting either for the other.
std::optional<std::size_t> first_jump(Formula* formula, const std::vector<NodeId>& equations,
                                      const Border& border);

// How much steeper each equation is above a border than below, per lhs - rhs: above - below is that
// times (lhs - rhs), exactly or to first order. Nothing where the graph does not show it.
std::optional<std::vector<NodeId>> steeper_above(Formula* formula,
                                                 const std::vector<NodeId>& equations,
                                                 const Border& border);

}  // namespace gearsweep
