// A trajectory with its derivative by the start, by the classical Runge-Kutta method on a phase
// grid. Where the motion crosses a limit of the backlash inside a step, the step is cut at the
// crossing: the field is continuous there, so nothing jumps, and the field of each part is smooth.
// Both the state and the derivative keep fourth order.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "model/held_step.hpp"
#include "orbits/contact_field.hpp"
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
  using Carried = HeldMotion;
  // What a Runge-Kutta step works on.
  struct Work {
    Carried at, slope, sum;
  };
  // A step of the phase grid. Places in it are told by shares of it, 0 to 1.
  struct GridStep {
    const double* coefs;   // rows at its start, middle and end
    double phase, length;  // where it starts, and its share of the grid
    double inside;         // a phase within its segment
  };
  // What is left of a step from a share on, and the contact that is held.
  struct Part {
    const GridStep& step;
    double from;
    Contact held;
  };
  // The depths at the start, in the middle and at the end of the way through a part.
  using Seen = std::array<Depths, 3>;
  // Where a flank meets the other or leaves it.
  struct Event {
    std::size_t flank;
    double share;
  };

  void advance(const GridStep& step);
  // On a row of phase coefficients.
  void take_return(const double* coefs, const Eigen::VectorXd& state);
  StepMoments moments_of(const GridStep& step) const;
  // Carries `carried` from the start of a part to a share of the step.
  Seen carry(const Part& part, double to, Carried* carried);
  Depths stage(const double* coefs, const Contact& held, const Carried& at, Carried* slope);
  const double* coefs_at(const GridStep& step, double share, std::vector<double>* row) const;

  // The first event of a part that begins at `start_`; nothing when there is none.
  std::optional<Event> first_event(const Part& part, const Seen& seen);
  // How far the motion from `start_` is on its side of a flank's limit at a share of the step.
  double clearance(const Part& part, std::size_t flank, double share);
  // Where the motion is nearest to a flank's limit, or farthest beyond it.
  struct Turn {
    double share, clearance;
  };
  Turn find_turn(const Part& part, std::size_t flank);
  // A share at which the motion is beyond the flank's limit; nothing when it is at none. Takes note
  // of how near it comes.
  std::optional<double> share_beyond(const Part& part, std::size_t flank, const Seen& seen);

  Model::PhaseRow row_at_;
  const PhaseGrid& grid_;
  double duration_;
  std::size_t row_width_;
  ContactField field_;
  HeldField held_;
  bool has_surfaces_;
  std::vector<Graze> grazes_;
  Extent extent_;
  ReturnLevel return_level_;
  ReturnCount returns_;
  Carried at_;     // where the trajectory is
  Carried start_;  // where the part of the step began that is being tried
  // Kept from step to step: allocating them anew costs more than a small model's right-hand side.
  Work moving_;
  Carried probe_;  // a state alone, to look for events
  Work probing_;
  RowMatrix jacobian_;
  std::array<std::vector<double>, 3> rows_;
};

}  // namespace gearsweep
