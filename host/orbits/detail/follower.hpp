// Orbits of a branch: points of a curve in the space of shooting's unknowns and the parameter.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "orbits/continuation.hpp"
#include "orbits/shooting.hpp"

namespace gearsweep {

// A solution of shooting: its unknowns and, as the last entry, the parameter in shares of the
// range; with the unit tangent of the branch.
struct BranchPoint {
  Eigen::VectorXd z, tangent;
  Orbit orbit;
  int iterations = 0;
};

inline constexpr double kHalved = 1e-9;  // half_return() of an orbit of half the period

class Follower {
 public:
  // Shooting takes its steps, divided by `coarseness`.
  Follower(const FollowRequest& request, const Orbit& start, std::size_t coarseness);

  double parameter_of(const BranchPoint& s) const { return s.z[s.z.size() - 1] * range_; }
  double range() const { return range_; }
  const Eigen::VectorXd& sizes() const { return sizes_; }

  // Takes over the sizes of an orbit where they are larger, and the length of a cycle; the solution
  // in them.
  BranchPoint grow_to(const BranchPoint& s);

  std::optional<BranchPoint> start(const Orbit& orbit) const;
  // The same cycle from another of its moments, and on in the same direction: along a branch the
  // moment that a cycle begins at may come to a surface. Nothing where no other is farther off.
  std::optional<BranchPoint> start_elsewhere(const BranchPoint& s) const;

  // How far half the period is from bringing the orbit back; far when it has no half.
  double half_return(const BranchPoint& s) const;

  // The size of a cycle, in those of the largest one.
  double extent_of(const BranchPoint& s) const;

  // The solution on the plane through `guess` across `along`. Its tangent points along `along`.
  std::optional<BranchPoint> correct(const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& along) const;

  bool allowed(double parameter) const;
  PeriodMap map_at(double parameter) const;

 private:
  std::optional<BranchPoint> start(const Orbit& orbit, double parameter, bool upwards) const;
  ModelSetting setting_at(double parameter) const;
  Shooting shooting() const { return {form_, sizes_}; }
  // Derivative of the image by the parameter, by central differences (inside the allowed range). It
  // steers the iteration and is no part of what it converges to.
  std::optional<Eigen::VectorXd> by_parameter(double parameter, const Eigen::VectorXd& z) const;
  // What states change along the range: of equilibria, that is their size, which does not know from
  // where a state is counted; of cycles a part of it is the size of those that hardly move.
  Eigen::VectorXd sizes_along(const Orbit& start) const;

  const FollowRequest& request_;
  std::size_t coarseness_;
  double range_;
  OrbitForm form_;
  double first_steps_, step_;  // of the first cycle, and how long they are in dimensionless time
  Eigen::VectorXd sizes_;
  Eigen::VectorXd widest_;  // sizes of orbits so far, the largest
  Extent states_;           // of equilibria so far
};

}  // namespace gearsweep
