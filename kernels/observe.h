// What observables see. Each has one life cycle:
//   NAME_init(sums, start)          at the moment where the record begins
//   NAME_step(sums, step)           after each step, whose middle it sees, too
//   NAME_end_period(sums, section)  after each recorded period
//   NAME_finish(sums, round, out)   its outputs, once all periods are recorded
// sums are the numbers that an observable keeps during the record. An observable with
// NAME_PER_CHANNEL looks at one state or signal: its init gets the value at the start; its step
// gets the values at the step's four moments, and the step. One with NAME_PER_CONTACT gets the
// depths of a contact instead. One with NAME_PER_SECTION looks at a section of the model: its step
// gets how the step comes through it, and the step. One with NAME_PER_SURFACE looks at a surface
// where the state is reset:
//   NAME_meet(sums, hit, rate, once) where it is met, at a rate of its level; once: as of Step

// An instant on the phase grid. At a break phase there are two of them.
typedef struct {
  ModelSignals signals;
  real x[MODEL_STATE_COUNT];
#ifdef ORDER_COUNT
  OrdersAt orders;
#endif
} Instant;

// A share of a period. A model with surfaces cuts its steps, each lane by itself.
#ifdef MODEL_SURFACES
typedef real Share;
#else
typedef scalar Share;
#endif

// What a moment counts in averages, and what happens there in counts; place: of the record, from 0
// to 1. What is driven comes round in whole periods, and so does the record. A motion without a
// clock has a time of its own, and the record begins and ends somewhere within it: a window that
// opens and closes smoothly, of mean 1, lets these parts count by the cube of the number of its
// cycles less (F. J. Harris, Proceedings of the IEEE 66 (1978) 51-83: windows).
#ifdef MODEL_CLOCKLESS
#define WINDOW_SQUARES (10.0 / 7.0)  // the mean of its square
#else
#define WINDOW_SQUARES 1
#endif
SHARED_FN Share window_weight(Share place) {
#ifdef MODEL_CLOCKLESS
  const scalar one = 1;
  const Share opening = place * (one - place);
  return (scalar)(30) * (opening * opening);
#else
  (void)place;
  return (scalar)(1);
#endif
}

// How far a contact's deflection is beyond the limits of its flanks; of one that is one-sided the
// back flank is never reached.
typedef struct {
  real drive, back;
  real backlash;
} ContactDepths;

SHARED_FN ContactDepths contact_depths(real deflection, real backlash, bool is_one_sided) {
  const real one = 1;
  const real back = -deflection - backlash;
  const ContactDepths depths = {deflection - backlash, is_one_sided ? -one : back,
                                is_one_sided ? one : backlash};
  return depths;
}

// How a step comes through a section (section_crossing.h).
typedef struct {
  mask where;                 // whether it does
  real share;                 // of the step, at which it does
  real x[MODEL_STATE_COUNT];  // the state there
  real last;                  // the section's level where the step before ended
} SectionCrossing;

// Where samples go, [sample][chosen state][item], so many for each point.
typedef struct {
  __global real* numbers;
  uint samples, items, item;
} Series;

// What observables see of a step: its start, middle and end, and the moment half a step before
// them. Between these a quantity follows a cubic (step_curve.h).
typedef struct {
  const Instant* earlier;  // half a step before `before`
  const Instant* before;
  const Instant* middle;
  const Instant* after;
  Share share;   // the step's length, as a share of a period
  Share weight;  // what it counts in averages: its share, in the record's window
  Share once;    // what counts in it as happening once
  mask smooth;   // the same flanks touch at start, middle and end
  mask stays;    // the motion stays at a surface
  real cubic;    // 0 where `earlier` lies in another segment, or in a step that is not smooth
  const SectionCrossing* crossings;  // of the sections that the study looks at, in its order
  const Series* series;
} Step;

#include "step_curve.h"

// The end of a recorded period.
typedef struct {
  const real* x;
  const Instant* end;          // x and what a verdict has no need of: it may be another moment
  const real* log_stretching;  // logarithm of how far each tangent vector grew in the period
  const Extent* extent;        // of the motion in the period
  real period;                 // in dimensionless time
  uint number;                 // periods recorded before
  uint record;                 // periods that will be recorded in all
  // Where samples go, [sample][chosen state][item]; null when none is kept of this section.
  __global real* series;
  uint items, item;
} Section;

// What a recorded period counts where it gives one number: by the window at its middle, over the
// mean of these.
SHARED_FN Share period_weight(const Section* section) {
  const Share one = 1;
  const Share share = one / (scalar)(section->record);
#ifdef MODEL_CLOCKLESS
  const Share mean = one + (scalar)(0.875) * (share * share) * (share * share);
#else
  const Share mean = 1;
#endif
  const Share place = ((scalar)(section->number) + (scalar)(0.5)) * share;
  return window_weight(place) / mean;
}

#ifndef MODEL_SURFACES
SHARED_FN void take_moment(const ModelPoint* point, TABLE PhaseCoefs* stage, const real* x,
                           Instant* moment) {
  const PhaseCoefs phase = *stage;
  model_signals(point, &phase, x, &moment->signals);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) moment->x[i] = x[i];
#ifdef ORDER_COUNT
  moment->orders = phase.orders;
#endif
}
#endif

// Each observable counts its outputs from its list; some have one for each state, or for each
// order.
#define PER_STATE MODEL_STATE_COUNT
#define PER_ORDER ORDER_COUNT
#define COUNT_OUTPUT(suffix, unit, flags, meaning) +1
