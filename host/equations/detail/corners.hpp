// The corners of the equations that are no contacts, as of abs(x), and where they jump with a
// state.
#pragma once

#include <string>
#include <vector>

#include "equations/detail/formula.hpp"

namespace gearsweep {

// lhs = rhs, and how the equations change with lhs - rhs where that begins: [state].
struct Corner {
  std::string expression;  // that bends there
  NodeId lhs = 0, rhs = 0;
  std::vector<NodeId> direction;
};

// An expression as text; of what is a condition, "the condition x < c".
struct RoughPlace {
  std::string expression;
  std::size_t equation = 0;  // the first one that it is in
};

struct Corners {
  std::vector<Corner> list;
  // Corners that are not in the list: how they begin cannot be shown, or there are too many.
  std::vector<RoughPlace> uncorrected;
  std::vector<RoughPlace> jumps;
};

// More than these would take the device's compiler too long.
inline constexpr std::size_t kMaxCorners = 16;

// The corners of these equations, which are simplified. Adds nothing to the graph where nothing is
// listed.
Corners find_corners(Formula* formula, const std::vector<NodeId>& equations);

}  // namespace gearsweep
