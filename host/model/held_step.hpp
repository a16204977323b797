// Steps through the surfaces of a model and the limits of its contacts, on the host: a step is cut
// at each, so that the field of each of its parts is smooth. Both the state and its tangents keep
// the fourth order of the method.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "model/held_field.hpp"

namespace gearsweep {

// Moments of a step of a phase grid, told by shares of it.
struct StepMoments {
  const Model::PhaseRow* row_at;
  std::size_t width;     // numbers in a row
  double phase, length;  // where the step begins, and its share of the period
  double inside;         // a phase within its segment
  double period;         // in dimensionless time
  // The rows at its start, in its middle and at its end; null: worked out, as all others are.
  const double* rows = nullptr;

  // A row of phase coefficients; `row`: where one is kept that is worked out.
  const double* at(double share, std::vector<double>* row) const;
  std::vector<double> operator()(double share) const;
};

// Told each part of a step that has a length, once it has been taken: from and to where, and the
// motion there.
using PartCallback =
    std::function<void(double from, double to, const HeldMotion& before, const HeldMotion& after)>;

// Where a motion turns in front of a surface or a limit, or hardly beyond it.
struct Turn {
  std::size_t surface;  // after the surfaces, the limits of the contacts
  double clearance;     // HeldField::Clearance
  double bend;          // its second derivative by dimensionless time
  // Where the part of the step begins.
  const double* coefs;
  const Eigen::VectorXd* state;
};
using TurnCallback = std::function<void(const Turn&)>;

class HeldStep {
 public:
  // The field must outlive it.
  explicit HeldStep(HeldField* field) : field_(field) {}

  // Carries a motion through a part of a step by the classical Runge-Kutta method, on the sides
  // that are held, and back to what it slides along.
  void carry(const StepMoments& moment_at, double from, double to, HeldMotion* motion);

  // A step that is cut where the motion comes to a surface or to a limit of a contact, or leaves a
  // surface that it stays at. The place is found by halving, with the motion itself. A motion that
  // has more to cross than is followed is no number behind the step.
  void take(const StepMoments& moment_at, HeldMotion* motion, const PartCallback& each_part = {},
            const TurnCallback& each_turn = {});

 private:
  // What a Runge-Kutta step works on. Kept: allocating it anew costs more than a small model's
  // right-hand side.
  struct Work {
    HeldMotion at, slope, sum;
    Eigen::VectorXd middle;  // of the state, to the second order
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  };
  // Clearances at a share of the step.
  struct Look {
    double share;
    std::vector<HeldField::Clearance> values;
  };
  // A share at which the motion is on its side, and a later one at which it is not.
  struct Way {
    double inside, beyond;
  };
  // What is left of a step, from start_ on.
  struct Part {
    const StepMoments& moment_at;
    double from;
    const TurnCallback& each_turn;
  };

  void carry(const StepMoments& moment_at, double from, double to, HeldMotion* motion, Work* work);
  void stage(const double* coefs, const HeldMotion& at, Work* work);
  void look(double share, const double* coefs, const Eigen::VectorXd& state, Look* out);
  void look(const Part& part, double share, Look* out);
  double clearance(const Part& part, std::size_t index, double share);

  // The share at which the motion from start_ is just beyond what it comes to first; nothing where
  // there is nothing. looks_: at the start, in the middle, at the end.
  std::optional<double> first_event(const Part& part);
  std::optional<Way> way_beyond(const Part& part, std::size_t index);
  // The same where the motion comes near.
  std::optional<Way> way_beyond_near(const Part& part, std::size_t index);
  // A clearance at a share of the step.
  struct ClearanceAt {
    double share, clearance;
  };
  // Where a clearance between two looks is smallest; the one between them is smaller, or will be.
  ClearanceAt find_turn(const Part& part, std::size_t index, ClearanceAt low, ClearanceAt at,
                        ClearanceAt high);
  void tell_turn(const Part& part, std::size_t index, double clearance, double bend,
                 double spacing) const;

  HeldField* field_;
  HeldMotion start_;  // of the part
  HeldMotion probe_;  // a state alone, to look for events
  Work moving_, probing_;
  std::array<std::vector<double>, 3> rows_;
  std::vector<double> row_;
  std::array<Look, 3> looks_;
  std::vector<Look> close_;  // of the part, if something comes near
};

}  // namespace gearsweep
