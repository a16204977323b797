// Whether equations jump at a border.
#pragma once

#include <optional>
#include <vector>

#include "equations/detail/borders.hpp"

namespace gearsweep {

// The first equation that jumps at a border, that is, of which it cannot be shown that both sides
// are the same where lhs = rhs: by putting either for the other.
std::optional<std::size_t> first_jump(Formula* formula, const std::vector<NodeId>& equations,
                                      const Border& border);

}  // namespace gearsweep
