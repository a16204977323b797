// The derivative of a model along a tangent vector, with few operations: parts that several
// equations share are worked out once for each vector.
#pragma once

#include <cstddef>
#include <vector>

#include "equations/detail/lowering.hpp"

namespace gearsweep {

// coefficient times a tangent: of a state (below the number of states), or of a shared part
// (states + its place among these).
struct LinearTerm {
  NodeId coefficient;  // of states, point and phase
  std::size_t of;
};
using LinearSum = std::vector<LinearTerm>;

struct Linearization {
  std::vector<LinearSum> parts;    // in an order in which each is made of earlier ones
  std::vector<LinearSum> outputs;  // [output]
};

// outputs: nodes of the inner loop. The vertices of their graph are eliminated while that takes no
// more edges, those first that save most (Griewank and Walther, Evaluating Derivatives, 2nd ed.
// 2008, chapter 9: vertex elimination).
Linearization linearize(Formula* formula, const std::vector<NodeId>& outputs);

}  // namespace gearsweep
