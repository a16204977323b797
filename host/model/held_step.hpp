// Steps through the surfaces of a model, on the host.
#pragma once

#include <cstddef>
#include <functional>
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

  std::vector<double> operator()(double share) const;  // a row of phase coefficients
};

// Carries a motion through a part of a step by the classical Runge-Kutta method, on the sides that
// are held.
void carry_held(HeldField* field, const StepMoments& moment_at, double from, double to,
                HeldMotion* motion);

// Told each part of a step, once it has been taken: from and to where, and the motion there.
using PartCallback =
    std::function<void(double from, double to, const HeldMotion& before, const HeldMotion& after)>;

// A step that is cut where the motion comes to a surface or to a limit of a contact, or leaves a
// surface that it stays at. The place is found by halving, with the motion itself. A motion that
// has more to cross than is followed is no number behind the step.
void step_held(HeldField* field, const StepMoments& moment_at, HeldMotion* motion,
               const PartCallback& each_part = {});

}  // namespace gearsweep
