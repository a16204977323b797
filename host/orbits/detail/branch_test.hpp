// Where on a branch a multiplier crosses the unit circle, or an eigenvalue the imaginary axis.
#pragma once

#include <optional>

#include "orbits/detail/follower.hpp"

namespace gearsweep {

// A function of an orbit that changes sign at a bifurcation.
using BranchTest = double (*)(const BranchPoint&);
double at_plus_one(const BranchPoint& s);   // or at 0
double at_minus_one(const BranchPoint& s);  // 1 of an equilibrium
// Also changes sign where two real multipliers are each other's inverse, or two real eigenvalues
// each other's opposite, which is no bifurcation: is_pair_complex().
double at_pair(const BranchPoint& s);
// Whether it is a complex pair that is nearest to make at_pair() 0.
bool is_pair_complex(const Orbit& orbit);
// The parameter's part of the tangent: changes sign where the branch turns back.
double turning(const BranchPoint& s);

bool changes(BranchTest test, const BranchPoint& a, const BranchPoint& b);

// Whether a test's sign is more than rounding at one of two neighbours: an eigenvalue 0 of a model
// that conserves something, or the pair of a center, is at the border all along, and crosses
// nothing.
bool is_told(BranchTest test, const BranchPoint& a, const BranchPoint& b);

// Neighbours on a branch with a test function's zero between them, and where it is.
struct Bracket {
  BranchPoint low, high;
  double parameter = 0.0;
  double error = 0.0;  // infinite where the coarser follower finds no such orbits
  bool grazing = false;
};

// Halves the arclength between two solutions down to a bracket and then draws a straight line.
// Going on to the zero itself would gain nothing, and where branches cross there is no unique
// solution to find there.
std::optional<Bracket> locate(const Follower& follower, const Follower& coarser, BranchTest test,
                              const BranchPoint& a, const BranchPoint& b);

// A parameter, and how far it may be off.
struct Located {
  double parameter = 0.0, error = 0.0;
};
// Where the equilibrium inside a small cycle changes its stability: the cycle is born there.
// Nothing when there is no such place nearby.
std::optional<Located> locate_birth(const Follower& follower, const BranchPoint& small_cycle);

}  // namespace gearsweep
