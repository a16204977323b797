// Points of a plane of two parameters at which a periodic orbit bifurcates: the equations of
// shooting, and one more that says that a multiplier is on the unit circle at a given angle. It is
// the scalar that borders the singular matrix (W. Govaerts, Numerical Methods for Bifurcations of
// Dynamical Equilibria, 2000, chapter 3), so that nothing of it is singular at the border.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "borders/orbit_map.hpp"
#include "borders/parameter_plane.hpp"

namespace gearsweep {

enum class BorderKind {
  fold,               // a multiplier at +1: two orbits meet and vanish
  flip,               // at -1: the period doubles
  neimark_sacker,     // a pair at e^(+-i angle): the orbit becomes a torus
  symmetry_breaking,  // at +1, of a mirrored orbit: it breaks into two that mirror each other
  grazing,            // none of these: the orbit only just touches a limit, or only just leaves it
};

// "fold", "flip", "Neimark-Sacker", "symmetry breaking", "grazing".
std::string name_of(BorderKind kind);

// What the states, the angle and the parameters of a border are measured in.
struct BorderScale {
  Eigen::VectorXd sizes;  // of states, above 0
  PlanePlace ranges{};    // of the parameters
  double level = 1.0;     // of the limit that is grazed
};

// What is critical at a border: the left and the right null vector, of length 1, of the matrix that
// is singular there. Of a grazing border instead the moment at which it grazes, in forcing periods.
struct Critical {
  Eigen::VectorXcd left, right;
  double moment = 0.0;
};

struct BorderPoint {
  PlanePlace place{};
  Eigen::VectorXd state;  // of the orbit, at phase 0
  double angle = 0.0;     // of the multiplier: 0 of a fold and of a symmetry breaking, pi of a flip
  Eigen::VectorXcd multipliers;
  double residual = 0.0;  // of all equations, states in their sizes
  // Where they pass 0 the curve has a special point. fold_bend: the quadratic coefficient of the
  // motion across a fold (0 at a cusp). overlap: of the left and the right eigenvector, which are
  // orthogonal where a second multiplier is at the same place (resonances 1:1 and 1:2).
  double fold_bend = 0.0, overlap = 0.0;
  // How far the parameters move the orbit of a fold along the left eigenvector, as a share of how
  // far they move it at all. 0 where branches cross, as at a symmetry breaking: that is no fold.
  double transversality = 1.0;
  Eigen::VectorXd tangent;  // of the curve, in scaled unknowns, of length 1
  Critical critical;        // in scaled states
  int iterations = 0;

  // Whether no other multiplier is outside the unit circle: a motion that settles bifurcates here.
  bool is_of_stable_motion() const;
};

class BorderEquations {
 public:
  // All must outlive it. period: of the orbit that bifurcates, in forcing periods; odd of a
  // symmetry breaking. limit: that a grazing border grazes. Those two kinds take a map of the host.
  BorderEquations(const ParameterPlane& plane, OrbitMap* map, BorderKind kind, std::size_t period,
                  BorderScale scale, GrazedLimit limit = {});

  BorderKind kind() const { return kind_; }
  std::size_t period() const { return period_; }
  const GrazedLimit& limit() const { return limit_; }
  const ParameterPlane& plane() const { return plane_; }
  const BorderScale& scale() const { return scale_; }
  // Scaled unknowns: states in their sizes, the angle of a Neimark-Sacker border, both parameters
  // in their ranges.
  Eigen::Index unknowns() const { return states() + (has_angle() ? 3 : 2); }
  Eigen::VectorXd unknowns_of(const BorderPoint& point) const;
  PlanePlace place_of(const Eigen::VectorXd& unknowns) const;

  // Newton's method from a guess to the border in the plane across `across` through the guess. The
  // tangent of the point goes along it. near: what is critical at a neighbour. Nothing where it
  // does not converge, the parameters are not allowed, or it goes more than `reach` from the guess.
  std::optional<BorderPoint> correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& across,
                                     const Critical& near, double reach) const;
  // What the equations ask of a map at a point, the residual of them all by an answer to that, and
  // the derivative of the residual by the unknowns.
  OrbitQuery query_of(const BorderPoint& point) const;
  Eigen::VectorXd residual_of(const BorderPoint& point, const OrbitAnswer& answer) const;
  std::optional<Eigen::MatrixXd> slope_at(const BorderPoint& point) const;
  // Critical vectors near a guess: the singular ones of the smallest value. Not of a grazing
  // border.
  std::optional<Critical> critical_near(const Eigen::VectorXd& guess) const;

 private:
  // What the return map's derivative at a guess tells of the multiplier.
  struct State {
    Eigen::MatrixXd monodromy;  // scaled
    Critical critical;
    Critical stretch;  // the same as the bordered matrix gives them
    double overlap = 0.0;
    std::optional<LevelTurn> turn;
  };
  struct Linearized {
    Eigen::VectorXd residual;
    Eigen::MatrixXd slope;  // by the unknowns
    State state;
    double fold_bend = 0.0, transversality = 1.0;
  };

  Eigen::Index states() const { return scale_.sizes.size(); }
  bool has_angle() const { return kind_ == BorderKind::neimark_sacker; }
  bool grazes() const { return kind_ == BorderKind::grazing; }
  double angle_of(const Eigen::VectorXd& unknowns) const;
  OrbitQuery query_at(const Eigen::VectorXd& unknowns, const Critical& near) const;
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& derivative) const;
  Eigen::VectorXd return_of(const OrbitAnswer& answer, const Eigen::VectorXd& unknowns) const;
  // The residual at a guess; state: what else it tells.
  Eigen::VectorXd residual_of(const OrbitAnswer& answer, const Eigen::VectorXd& unknowns,
                              const Critical& near, State* state) const;
  std::optional<Linearized> at(const Eigen::VectorXd& unknowns, const Critical& near) const;
  void take_bend(const std::vector<std::optional<OrbitAnswer>>& answers,
                 const Eigen::VectorXd& unknowns, Linearized* out) const;
  BorderPoint point_at(const Eigen::VectorXd& unknowns, const State& state) const;

  const ParameterPlane& plane_;
  OrbitMap* map_;
  BorderKind kind_;
  std::size_t period_;
  BorderScale scale_;
  GrazedLimit limit_;
};

}  // namespace gearsweep
