// The step of a model that names none, found from its equations.
//
// Motions from a few of the study's points are followed in double precision on the host, with the
// method of the devices. A step of size h will do when
// - the error that it makes, told by one step against two halves, is at most 1e-7 of what each
//   state ranges over in the later half of the motion (1e-5 in the transient before). Chaos does
//   not spoil this, as no two motions are compared over more than a step;
// - h times the fastest rate of the motion, the largest modulus of the Jacobian's eigenvalues, is
//   at most 0.3: the exponent of a direction that decays at that rate is then right to 1e-4 of
//   itself. In the transient it is at most 2, where the method is stable;
// - a period of the forcing has 16 steps.
//
// Each is a number without a unit: scaling a state or time scales the step with it, and an offset
// of a state changes nothing. At these limits the steps that were measured for the models of the
// zoo (Model::max_step) come out within a factor of two or three.
//
// Steps in which a contact's limit is crossed are not counted, as devices correct them; nor those
// whose error does not fall as they are halved, where the right-hand side bends or jumps; where a
// model without a phase does neither, it is steep, and the steps are halved on.
#pragma once

#include <map>
#include <string>

#include "study/study.hpp"

namespace gearsweep {

struct OwnStep {
  double step = 0.0;     // in the model's time
  double longest = 0.0;  // before it was rounded
  std::string reason;    // "the fastest rate of the motion is 21.7", for the summary
  MotionReach reach;     // of those motions
};

// For a study whose axes, setting and start are known. The same study has the same step: it depends
// on no device. The step divides the period of the study's first point into a number of the ladder
// 2^(k/4), so that a unit of time does not change how it is rounded. Takes some milliseconds for
// each of up to nine points.
OwnStep find_own_step(const Study& study);

// The longest step that keeps that error of a motion that is in such a state at phase 0; 0 where it
// goes to infinity. state: of the whole model. Takes about a millisecond.
double step_of_error_at(const Model& model, const ModelSetting& setting,
                        const std::vector<double>& state);

// To the next number of that ladder.
double rounded_up(double steps);

// What each state and signal ranges over in the later half of such motions, by name: the median of
// the points. It knows no offset. Without motions that go to infinity.
std::map<std::string, double> motion_ranges(const Study& study);

}  // namespace gearsweep
