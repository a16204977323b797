// Newton's method for a fixed point of a return map, by shooting, for one point.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace gearsweep {

// Distances are relative to the ranges of the motion.
struct NewtonLimits {
  double same;     // a state that comes back to within this is the orbit's
  double close;    // where a step is no longer than this, the derivative is that at the orbit
  double far;      // the orbit sought lies no farther from where the trajectory is
  double weakest;  // smallest multiplier, relative to the largest, that rounding leaves
  std::vector<std::size_t> angles = {};  // states that mean the same after a full turn
  double lost = 0.0;                     // lost_multiplier()
  // After a step no longer than this towards an orbit that attracts well, its derivative serves the
  // steps that follow, too.
  double kept = 0.0;
};

// A multiplier of this modulus is rounding of 0, as where a motion has lost at a surface what its
// neighbours have across it; one of a model without surfaces is what it is.
constexpr double lost_multiplier(bool has_surfaces, bool fp64) {
  if (!has_surfaces) return 0.0;
  return fp64 ? 1.4e-14 : 7.6e-6;  // 64 roundings, as TANGENT_LOST
}

enum class NewtonVerdict {
  going_on,  // the state is a better guess now
  close,     // the state is as good as that of a stable orbit, the multipliers are its own
  found,     // close, and seen to come back
  unstable,  // the orbit is not stable
  failed,    // too far, too slow, or not told from rounding
};

struct NewtonTry {
  std::vector<double> start;   // where the trajectory is
  std::vector<double> ranges;  // [state] of the motion there, none 0
  std::vector<double> state;   // the guess
  // How far the guess before this one was from coming back.
  double distance = std::numeric_limits<double>::infinity();
  // The length of the last step that came close: how far from the orbit the derivative was taken.
  double step = 0.0;
  // Logarithms of the absolute values of the multipliers over the whole map, largest first; of an
  // orbit that is surely stable only a bound of the largest, where none is needed.
  std::vector<double> log_multipliers;
};

// The logarithm of the largest absolute value of a multiplier, of a return map's derivative
// ([column][row]); NaN when there is none. lost: lost_multiplier().
double largest_log_multiplier(std::span<const double> derivative, std::size_t states, double lost);

// Whether a state comes back: it is the same as its map.
bool comes_back(std::span<const double> mapped, const NewtonLimits& limits, const NewtonTry& one);

// One step, from the map of one->state and its derivative ([column][row]). `tangents`: of so many
// multipliers the values are needed. Never `found`.
NewtonVerdict newton_step(std::span<const double> mapped, std::span<const double> derivative,
                          const NewtonLimits& limits, std::size_t tangents, NewtonTry* one);

// What a `close` state turns out to be, from its map alone and the derivative of the step before
// (with which the state takes one step more): found, going_on or, where it comes nearer fast
// enough, close again.
NewtonVerdict newton_confirm(std::span<const double> mapped, std::span<const double> derivative,
                             const NewtonLimits& limits, NewtonTry* one);

}  // namespace gearsweep
