// What model_linearize and model_tangent of a model's kernel work out.
#pragma once

#include <vector>

#include "equations/detail/lowering.hpp"

namespace gearsweep {

struct TangentProgram {
  NodeId scale;                       // symbol
  std::vector<NodeId> tangent, base;  // symbols: [state]
  std::vector<NodeId> fields;         // symbols: what the derivative at a state is made of
  std::vector<NodeId> field_values;
  std::vector<NodeId> rows;      // [state]: base + scale J tangent, of the symbols above
  std::vector<NodeId> contacts;  // [contact][deflection, backlash]: what the tangent adds to them
  // Symbols beside those of Lowered, and what they are made of: parameters.
  std::vector<NodeId> point, point_values;
};

// Adds to the formula's graph.
TangentProgram tangent_program(Formula* formula, const Lowered& lowered);

}  // namespace gearsweep
