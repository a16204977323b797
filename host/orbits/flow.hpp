// A trajectory with its derivative by the start, by the classical Runge-Kutta method on a phase
// grid. Steps are cut where the motion comes to a surface or to a limit of a contact
// (model/held_step.hpp).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "model/held_step.hpp"
#include "orbits/returns.hpp"
#include "plan/phase_grid.hpp"

namespace gearsweep {

// Where a motion turns nearest to a limit of a backlash: it nearly touches, or hardly parts.
struct Graze {
  double distance = std::numeric_limits<double>::infinity();  // from the limit
  double bend = 0.0;                                          // second derivative by time there
  // The field's Jacobian gains force * gradient at the limit; the gradient is the distance's own.
  Eigen::VectorXd force;
  Eigen::RowVectorXd gradient;
};

// The smallest and the largest value of each state.
struct Extent {
  Eigen::VectorXd min, max;

  void take(const Eigen::VectorXd& state);
  Eigen::VectorXd reach() const { return min.cwiseAbs().cwiseMax(max.cwiseAbs()); }
  Eigen::VectorXd swing() const { return 0.5 * (max - min); }
};

class Flow {
 public:
  // From `state` at phase 0. The grid takes `duration`, in dimensionless time: a forcing period, or
  // of a model without a phase what is asked for. `tangents`, one a column, travel with the state;
  // none: only the state.
  Flow(const Model& model, const ModelSetting& setting, PreparedPoint* point, const PhaseGrid& grid,
       double duration, const Eigen::VectorXd& state, const Eigen::MatrixXd& tangents);

  // Through the whole grid. counts_returns: of a motion that nothing drives.
  void advance_grid(bool counts_returns = false);

  const Eigen::VectorXd& state() const { return at_.state; }
  const Eigen::MatrixXd& tangents() const { return at_.tangents; }
  // The nearest that the way so far comes to each limit of a backlash, in the order of
  // contact_limits().
  const std::vector<Graze>& nearest_grazes() const { return grazes_; }
  // The extent of the way so far, at the ends of its steps.
  const Extent& extent() const { return extent_; }
  // Those of the way so far that were to be counted.
  const ReturnCount& returns() const { return returns_; }

 private:
  // On a row of phase coefficients.
  void take_return(const double* coefs, const Eigen::VectorXd& state);
  void take_turn(const Turn& turn);

  Model::PhaseRow row_at_;
  const PhaseGrid& grid_;
  double duration_;
  std::size_t row_width_;
  std::size_t surfaces_;
  ContactField contacts_;
  HeldField held_;
  HeldStep step_;
  std::vector<Graze> grazes_;
  Extent extent_;
  ReturnLevel return_level_;
  ReturnCount returns_;
  HeldMotion at_;
};

}  // namespace gearsweep
