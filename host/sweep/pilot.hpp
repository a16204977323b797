// The choice of the integration step: a pilot run finds it for integrate.tolerance.
//
// A sub-grid of the study is computed with a short step and with longer ones. A step will do when
// each map that the study asks for keeps its tolerance, as a share of the map's range, at 99 % of
// the points that are on periodic orbits; and when its mean over the other points is the same, to
// within what chaos lets tell. Of the steps that will do, the longest of a ladder is taken.
//
// Some points land on another orbit at any change of the step, because their way there is chaotic.
// They show when the step is halved several times: their errors do not shrink, as those of all
// other points do, be it slowly. As many points more may be off.
//
// Where exponents of orbits alone need shorter steps, the run keeps those of all other maps, and
// the orbits that points stop on take a quarter of them (Integrate::orbit_steps): other motion has
// exponents with statistical errors, which short steps do not make smaller.
//
// All this is relative to the maps' ranges and to the model's own step, so neither units nor
// offsets matter. Nothing in it depends on the device but for its rounding.
#pragma once

#include <optional>

#include "sweep/sweep_options.hpp"

namespace gearsweep {

// A study whose integration step is known.
struct SteppedStudy {
  Study study;
  std::optional<PilotFindings> pilot;  // nothing where no pilot run has told
};

// The study as it is, or with the step that a pilot run finds as its max_step. Nothing when
// stopped. Throws InputError when the study asks for a tolerance that no step keeps, or that no
// point can tell.
std::optional<SteppedStudy> choose_step(const Study& study, const SweepOptions& options);

// The axis at no more than `count` of its places, spread evenly, both ends among them.
Axis thin(const Axis& axis, std::size_t count);

}  // namespace gearsweep
