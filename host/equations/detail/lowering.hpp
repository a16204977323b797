// A formula cut into what is worked out once for each point, what is tabulated over the phase, and
// what is left for the inner loop.
#pragma once

#include <vector>

#include "equations/detail/contacts.hpp"
#include "equations/detail/corners.hpp"
#include "equations/detail/formula.hpp"

namespace gearsweep {

// In the inner loop, symbols are states and those of `point` and `coefs`.
struct Lowered {
  std::vector<NodeId> point, point_values;  // symbols, and what they are made of: parameters
  std::vector<NodeId> coefs, coef_values;   // symbols, and what they are made of: phase, parameters
  std::vector<bool> shapes_phase;           // [parameter]: coefficients depend on it
  // The first half of the states are positions, the second half their velocities, in the same
  // order.
  bool is_second_order = false;
  std::vector<NodeId> equations, signals;
  std::vector<NodeId> jacobian;  // [row][column]
  Contacts contacts;
  // Corners that are no contacts and are not corrected, and jumps with a state.
  std::vector<RoughPlace> uncorrected, jumps;
};

// Simplifies, and adds to, the formula's graph.
Lowered lower(Formula* formula);

}  // namespace gearsweep
