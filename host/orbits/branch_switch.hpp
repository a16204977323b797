// Goes from a branch of orbits to those that leave it: where the period doubles to the orbits of
// twice the period, where branches cross, as where a symmetry breaks, to the other branch (E. J.
// Doedel, H. B. Keller, J. P. Kernevez, International Journal of Bifurcation and Chaos 1 (1991)
// 493-520). A doubled orbit a period later is the same one, and of two branches of broken orbits
// that mirror each other one tells all of the other: one of each is followed.
#pragma once

#include <cstddef>
#include <vector>

#include "orbits/continuation.hpp"

namespace gearsweep {

// An orbit on a branch that leaves another one, next to where it does, and the way on from there.
struct BranchStart {
  double parameter = 0.0;
  Orbit orbit;
  bool upwards = true;
};

// Whether a branch leaves there that can be gone to: at flips, and where branches of driven motions
// cross. Not where the branch itself was born.
bool has_leaving_branch(const LocatedBifurcation& at);

// One orbit for each direction of the parameter in which the other branch goes; none where Newton's
// method finds no orbit beside the followed branch. request: of the branch that `at` is on.
std::vector<BranchStart> leaving_branches(const FollowRequest& request,
                                          const LocatedBifurcation& at);

// So many are followed at most: what has more has one for each of many folds.
inline constexpr std::size_t kMaxLeaving = 64;

struct LeavingBranch {
  std::size_t parent = 0;  // the number of the branch that it leaves, from 1 on; 0: the first one
  LocatedBifurcation origin;
  std::size_t period = 1;        // of its orbits
  std::vector<Branch> branches;  // in each direction in which it goes; none: no orbit was found
};

// Follows what leaves these branches, and what leaves that, so many generations deep, kMaxLeaving
// in all. A branch that comes back to one that was followed is followed once. each_orbit of the
// request is told of all.
std::vector<LeavingBranch> follow_leaving(const FollowRequest& request,
                                          const std::vector<Branch>& branches,
                                          std::size_t generations);

}  // namespace gearsweep
