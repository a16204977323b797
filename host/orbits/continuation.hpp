// Follows an orbit through a parameter by pseudo-arclength continuation (H. B. Keller, in
// Applications of Bifurcation Theory, 1977), stable or not and around folds, and locates the
// bifurcations that it meets.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "orbits/floquet.hpp"

namespace gearsweep {

// An orbit of a branch and the value of the parameter that it belongs to.
struct BranchOrbit {
  double parameter = 0.0;
  Orbit orbit;
};

// An orbit at which a multiplier is on the unit circle, or an eigenvalue on the imaginary axis.
struct LocatedBifurcation {
  Bifurcation kind = Bifurcation::fold;
  double parameter = 0.0;
  double error = 0.0;        // of the parameter, at most: see orbit_error.hpp
  Orbit orbit;               // next to it, on the branch that was followed
  bool grazing = false;      // so near to a limit of the backlash that the error is the bracket's
  std::size_t born_of = 0;   // period of the orbits that the branch was born of here; 0: it was not
  Eigen::VectorXd way = {};  // of the branch through it: the states' change, then the parameter's
};

struct Branch {
  bool upwards = true;                           // as the request
  std::vector<BranchOrbit> orbits;               // in the order in which they were met
  std::vector<LocatedBifurcation> bifurcations;  // the same
  std::string ended;                             // why, in words: "reached omega = 0.8"
};

struct FollowRequest {
  const Model* model = nullptr;
  ModelSetting setting;       // of the starting orbit
  std::size_t parameter = 0;  // index of the parameter to follow along
  double from = 0.0;          // the branch is left when the parameter leaves from .. to
  double to = 0.0;            // from < to
  // Minimum number of steps per period, as in PeriodMap. A cycle has its own.
  std::size_t steps = 0;
  bool upwards = true;                      // direction of the parameter at the start
  const std::atomic<bool>* stop = nullptr;  // as in PeriodMap
  // Told of each orbit, the last one of the branch so far; empty: nobody asks.
  std::function<void(const Branch& so_far)> each_orbit = {};
  // It has just left another branch: how fast it changes along the parameter says nothing of its
  // size.
  bool is_at_bifurcation = false;
};

// Follows the orbit `start` of `request.setting`. Bifurcations are located to about 1e-9 of the
// range; two of one kind within one step of the branch (at most 2 % of range and state) are missed.
// Ends where the parameter leaves the range or the branch was born, of cycles at a Hopf
// bifurcation, too; earlier when there is no smooth way on, as at a corner of the branch: see
// Branch::ended.
Branch follow_orbit(const FollowRequest& request, const Orbit& start);

}  // namespace gearsweep
