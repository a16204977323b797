// How much steeper equations are on one side of a border than on the other.
#pragma once

#include <optional>
#include <vector>

#include "equations/detail/borders.hpp"

namespace gearsweep {

// How much steeper each equation is above a border than below, per lhs - rhs: above - below is that
// times (lhs - rhs), exactly or to first order. Nothing where the graph does not show it.
std::optional<std::vector<NodeId>> steeper_above(Formula* formula,
                                                 const std::vector<NodeId>& equations,
                                                 const Border& border);

}  // namespace gearsweep
