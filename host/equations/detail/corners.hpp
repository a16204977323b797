// The corners of the equations that are no contacts, as of abs(x), and where they jump with a
// state.
#pragma once

#include <map>
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

// Where the equations jump: lhs = rhs, or, of a staircase, where lhs is a whole number.
struct Jump {
  RoughPlace place;
  NodeId lhs = 0, rhs = 0;
  bool is_staircase = false;
  // What each node that jumps there is on either side; of a staircase, floor(lhs) itself.
  std::map<NodeId, NodeId> above, below;
};

struct Corners {
  std::vector<Corner> list;
  // Corners that are not in the list: how they begin cannot be shown, or there are too many.
  std::vector<RoughPlace> uncorrected;
  std::vector<Jump> jumps;  // that steps can be cut at
  // Jumps that they cannot: of atan2, of a jump within a jump, at a table, or there are too many.
  std::vector<RoughPlace> unlocated;
};

// More than these would take the device's compiler too long.
inline constexpr std::size_t kMaxCorners = 16;
inline constexpr std::size_t kMaxJumps = 8;

// False where none of these can jump with a state.
bool may_jump(const Formula& formula, const std::vector<NodeId>& equations);

// The corners of these equations, which are simplified. Adds nothing to the graph where nothing is
// listed.
Corners find_corners(Formula* formula, const std::vector<NodeId>& equations);

}  // namespace gearsweep
