// One point's trajectory by the classical Runge-Kutta method in Eigen: the reference engine's own
// integrator, which shares nothing with the kernels but the model's formula and the phase grid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "model/held_step.hpp"
#include "plan/plan.hpp"

namespace gearsweep {

// An instant of a trajectory: the state and the model's signals there.
struct Instant {
  Eigen::VectorXd state, signals;
};

// A step of the classical method, and its middle by Hermite's cubic between its ends.
struct TrajectoryStep {
  Instant before = {}, middle = {}, after = {};
  double share = 0.0;   // of the period
  double weight = 0.0;  // what it counts in averages: its share, in the record's window
  double once = 1.0;    // what counts in it as happening once, and where it begins
  double once_before = 1.0;
  bool ends_step = true;   // false of a part of a step that others follow
  bool is_smooth = false;  // no limit of the contact, nor a bend, lies between the three moments
  // The middle of the step before, when that was smooth and lies in the same segment.
  std::optional<Instant> earlier = {};
  bool stays = false;                    // at a surface
  std::vector<HeldField::Met> met = {};  // impacts since the step before
  // Any moment, by a step of the method from `before` to that share of this one.
  std::function<Instant(double share)> at = {};
};
using StepCallback = std::function<void(TrajectoryStep&)>;

class Trajectory {
 public:
  // `state` at phase 0. The plan must outlive the trajectory.
  Trajectory(const Plan& plan, std::size_t point, const Eigen::VectorXd& state);

  // From now on these tangent vectors, one a column, travel with the state: W' = J(t, x(t)) W by
  // the same stages. Advancing by a period from the unit matrix gives the monodromy matrix.
  void set_tangents(const Eigen::MatrixXd& tangents) { tangents_ = tangents; }
  const Eigen::MatrixXd& tangents() const { return tangents_; }

  // Advances by one period, at whose end full turns are taken out of angles; false when the state
  // left the range that counts as finite.
  bool advance_period();
  // on_the_way: called every few steps, so that tangents can be kept from growing beyond numbers.
  bool advance_period(const StepCallback& each_step,
                      const std::function<void()>& on_the_way = std::function<void()>());

  const Eigen::VectorXd& state() const { return state_; }
  std::size_t steps_per_period() const { return grid_.steps; }
  const PhaseGrid& grid() const { return grid_; }
  // Length of the period in dimensionless time.
  double period() const { return point_->period(); }
  // HeldField::take_slid().
  bool take_slid() { return held_.take_slid(); }

 private:
  // A state with its tangents, or their rates of change.
  using Bundle = HeldMotion;

  Bundle slope(std::size_t row, const Bundle& at) const;
  Instant moment(std::size_t row, const Eigen::VectorXd& state) const;
  Instant moment_within(const StepMoments& moment_at, const Eigen::VectorXd& start,
                        double share) const;
  // Returns the state in the middle of the step.
  Eigen::VectorXd step(std::size_t row, double h);
  // For a model with surfaces. seen: told the step's parts.
  void step_through_surfaces(const StepMoments& moment, const StepCallback& seen);
  // Those of a step that begins at a row of the grid, and at a phase.
  StepMoments moments_of(std::size_t row, double phase, double inside, double share) const;
  Instant held_instant(const std::vector<double>& coefs, const Eigen::VectorXd& state);
  bool same_contact(const Instant& a, const Instant& b) const;
  // p of a limit (ContactLimit), by a row of coefficients and a state.
  double beyond(const ContactLimit& limit, std::size_t row, const Eigen::VectorXd& state) const;
  // Correct the step's end for the crossings of the contacts' limits between its evaluations `at`.
  void correct_crossings(std::size_t row, double h, const std::array<Bundle, 4>& at);
  void correct_crossing(const ContactLimit& limit, std::size_t row, double h,
                        const std::array<Bundle, 4>& at);

  const Model& model_;
  PhaseGrid grid_;
  std::size_t row_width_, signal_count_, place_count_;
  std::vector<std::size_t> angles_;  // states
  std::vector<ContactInfo> contacts_;
  std::vector<ContactLimit> limits_;
  bool is_rough_;
  bool has_events_;  // steps that cross a limit are corrected
  Model::PhaseRow row_at_;
  std::unique_ptr<PreparedPoint> point_;
  HeldField held_;
  HeldStep held_step_;
  Eigen::VectorXd state_;
  Eigen::MatrixXd tangents_;
};

}  // namespace gearsweep
