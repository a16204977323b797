// A formula cut into what is worked out once for each point, what is tabulated over the phase, and
// what is left for the inner loop.
#pragma once

#include <optional>
#include <vector>

#include "equations/detail/formula.hpp"

namespace gearsweep {

struct Contact {
  NodeId penetration;           // the symbol that stands for it in `in_contact`
  NodeId deflection, backlash;  // of states, point and phase
  bool may_be_negative;         // the backlash: then both flanks may touch at once
};

// In the inner loop, symbols are states and those of `point` and `coefs`.
struct Lowered {
  std::vector<NodeId> point, point_values;  // symbols, and what they are made of: parameters
  std::vector<NodeId> coefs, coef_values;   // symbols, and what they are made of: phase, parameters
  std::vector<bool> shapes_phase;           // [parameter]: coefficients depend on it
  std::vector<NodeId> equations, signals;
  std::vector<NodeId> jacobian;  // [row][column]
  // Of a model with one backlash whose force has a direction that no state changes.
  std::optional<Contact> contact;
  std::vector<NodeId> in_contact;  // the equations, where the penetration is known
  std::vector<NodeId> force_direction, force_direction_carried;
  std::vector<NodeId> direction;  // symbols, which force_direction_carried is made of
};

// Simplifies, and adds to, the formula's graph.
Lowered lower(Formula* formula);

}  // namespace gearsweep
