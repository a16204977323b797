// A formula cut into what is worked out once for each point, what is tabulated over the phase, and
// what is left for the inner loop.
#pragma once

#include <utility>
#include <vector>

#include "equations/detail/contacts.hpp"
#include "equations/detail/corners.hpp"
#include "equations/detail/formula.hpp"

namespace gearsweep {

// Where the equations jump, and the side of it that they are held on, or where the state is reset.
struct Surface {
  std::string name;  // of one where the state is reset
  RoughPlace place;  // of another one
  NodeId level = 0;  // of states, point and phase: 0 where they jump; of a staircase a whole number
  NodeId drift = 0;  // how it changes in time, with the phase alone
  bool is_staircase = false;
  NodeId side = 0;  // symbol: 1 where the level is above 0, 0 below it; of a staircase its floor
  // What a motion that stays at it keeps: along a jump the level, at a stop the level's rate; and
  // how that changes in time, with the phase alone.
  NodeId held = 0, held_drift = 0;
  // The reset of a surface by state, empty where it resets none; how that changes in time; and what
  // a reset by a small rate changes.
  std::vector<NodeId> reset, reset_drift, turn;
};

// In the inner loop, symbols are states, sides and those of `point` and `coefs`.
struct Lowered {
  std::vector<NodeId> point, point_values;  // symbols, and what they are made of: parameters
  std::vector<NodeId> coefs, coef_values;   // symbols, and what they are made of: phase, parameters
  std::vector<bool> shapes_phase;           // [parameter]: coefficients depend on it
  // The first half of the states are positions, the second half their velocities, in the same
  // order.
  bool is_second_order = false;
  std::vector<NodeId> equations;
  std::vector<NodeId> signals;   // of the formula, then level, rate and size of each section
  std::vector<NodeId> jacobian;  // [row][column]
  Contacts contacts;
  std::vector<Surface> surfaces;
  // What surfaces are made of: the places in `coefs` of a coefficient and of its derivative by the
  // phase; and the phase that a period takes, of parameters.
  std::vector<std::pair<std::size_t, std::size_t>> phase_slopes;
  NodeId phase_turn = 0;
  // Corners that are no contacts and are not corrected, and jumps with a state that steps are not
  // cut at.
  std::vector<RoughPlace> uncorrected, jumps;
};

// Simplifies, and adds to, the formula's graph.
Lowered lower(Formula* formula);

}  // namespace gearsweep
