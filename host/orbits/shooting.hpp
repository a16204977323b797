// Newton's method on what brings an orbit back: the period map of a forced motion; of a cycle the
// flow for a time that is an unknown, too, with a phase condition; of an equilibrium the field.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "orbits/floquet.hpp"

namespace gearsweep {

// What orbits of one branch have in common.
struct OrbitForm {
  OrbitKind kind = OrbitKind::forced;
  std::size_t period = 1;  // of a forced orbit
  std::size_t steps = 1;   // of a cycle
  // In dimensionless time. What the length of a cycle is told in; of an equilibrium the time along
  // the field by which a state is taken to judge it.
  double time = 1.0;
};

OrbitForm form_of(const Orbit& orbit);

// A hyperplane across a motion, which a cycle's state lies on. No direction: of another orbit.
struct PhasePlane {
  Eigen::VectorXd place, direction;  // in sizes of states; a unit vector
};

// The equations of shooting. Their unknowns are the states in their sizes and, of a cycle, its
// length in OrbitForm::time.
class Shooting {
 public:
  Shooting(const OrbitForm& form, Eigen::VectorXd sizes);

  const OrbitForm& form() const { return form_; }
  const Eigen::VectorXd& sizes() const { return sizes_; }
  Eigen::Index states() const { return sizes_.size(); }
  Eigen::Index unknowns() const { return states() + (has_length() ? 1 : 0); }

  Eigen::VectorXd unknowns_of(const Orbit& orbit) const;
  Eigen::VectorXd state_of(const Eigen::VectorXd& unknowns) const;
  double duration_of(const Eigen::VectorXd& unknowns) const;

  PhasePlane plane_at(const PeriodMap& map, const Eigen::VectorXd& unknowns) const;

  // The equations at a guess, to the first order, and what they were made of.
  struct Equations {
    Eigen::VectorXd residual;  // 0 on an orbit
    Eigen::VectorXd rounding;  // magnitudes whose rounding is that of the residual
    Eigen::MatrixXd slope;     // by the unknowns
    PeriodImage image;
  };
  // Nothing when the motion leaves the range, or the length is none.
  std::optional<Equations> at(const PeriodMap& map, const Eigen::VectorXd& unknowns,
                              const PhasePlane& plane) const;
  // Where the states come to, in their sizes.
  std::optional<Eigen::VectorXd> image(const PeriodMap& map, const Eigen::VectorXd& unknowns) const;

  Orbit orbit_at(const PeriodMap& map, const Eigen::VectorXd& unknowns,
                 const PeriodImage& image) const;

 private:
  bool has_length() const { return form_.kind == OrbitKind::cycle; }
  std::optional<PeriodImage> linearize(const PeriodMap& map, const Eigen::VectorXd& unknowns) const;

  OrbitForm form_;
  Eigen::VectorXd sizes_;
};

// Damped Newton's method on the `period`-th iterate from `guess`, to 1e-12 of the states' sizes.
// Nothing when it does not converge. The result's period is `period`, be it the smallest or not.
std::optional<Orbit> shoot(const PeriodMap& map, const Eigen::VectorXd& guess, std::size_t period);

// The same of a cycle: its length is looked for near that of `span`.
std::optional<Orbit> shoot_cycle(const PeriodMap& map, const Eigen::VectorXd& guess,
                                 const TimeSpan& span);

// The orbit of `map` near one of another map, with `steps` steps where it is a cycle.
std::optional<Orbit> shoot_again(const PeriodMap& map, const Orbit& near, std::size_t steps);

// The equilibrium that Newton's method comes to from a state, stable or not. way: how far each
// state may have come from, of which rounding is no state other than 0.
std::optional<Orbit> find_equilibrium(const PeriodMap& map, const Eigen::VectorXd& guess,
                                      const Eigen::VectorXd& way);
std::optional<Orbit> find_equilibrium(const PeriodMap& map, const Eigen::VectorXd& guess);

}  // namespace gearsweep
