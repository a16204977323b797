// Impacts: how often each flank is regained, a contact that begins and ends inside a step included
// (contact_touch.h); the hardest by its speed, at which the depth |D| - b' grows where it passes 0;
// and the largest depth of the contacts that begin with an impact. A flank that is regained at all
// has no other contacts in a periodic motion, so that is the largest depth of such a flank over the
// record; the force is what the model's stiffness makes of it.
#include "observables/extrema.h"

#define CONTACT_IMPACTS_ROLE measure
#define CONTACT_IMPACTS_PER_CONTACT
// X(suffix of the quantity's name, unit (empty: the deflection's, /tau: its rate's, /period: how
// often), flag meanings, meaning)
#define CONTACT_IMPACTS_OUTPUTS(X)                                                        \
  X(drive, "/period", "", "impacts on the drive flank (contacts regained)")               \
  X(back, "/period", "", "impacts on the back flank (contacts regained)")                 \
  X(speed, "/tau", "", "speed of the hardest impact, at which deflection and limit meet") \
  X(depth, "", "", "largest depth beyond the limit of a flank that is regained; 0 without impacts")
// X(suffix, role)
#define CONTACT_IMPACTS_OUTPUT_ROLES(X) X(drive, impacts_drive) X(back, impacts_back)

enum {
  contact_impacts_drive,
  contact_impacts_back,
  contact_impacts_speed,
  contact_impacts_period_speed,  // in the running period, per period
  contact_impacts_drive_depth,
  contact_impacts_back_depth = (int)(contact_impacts_drive_depth) + (int)(extrema_accumulators),
  contact_impacts_accumulators = (int)(contact_impacts_back_depth) + (int)(extrema_accumulators)
};

#ifdef __OPENCL_VERSION__
#include "contact_touch.h"

enum { contact_impacts_outputs = CONTACT_IMPACTS_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void contact_impacts_init(real* sums, ContactDepths start) {
  for (int i = 0; i < contact_impacts_drive_depth; ++i) sums[i] = 0;
  extrema_init(sums + contact_impacts_drive_depth, start.drive);
  extrema_init(sums + contact_impacts_back_depth, start.back);
}

// Adds a step's impacts on a flank, by its depth at the step's four moments, and their speed.
SHARED_FN void contact_impacts_see(real earlier, real before, real middle, real after,
                                   const Step* step, real* count, real* speed) {
  const real zero = 0;
  ContactTouch touch;
  if (!contact_touch(earlier, before, middle, after, step->cubic, &touch)) return;
  const mask first = touch.changes & touch.in_first & !touch.on_before;
  const mask second = touch.changes & touch.in_second & !touch.on_turn;
  const Share per_period = (scalar)(2) / step->share;
  const real first_speed = per_period * step_curve_slope(&touch.depth, touch.first);
  const real second_speed = per_period * step_curve_slope(&touch.depth, touch.second);
  const real once = step->once;
  *count = *count + lane_select(first, once, zero) + lane_select(second, once, zero);
  *speed = lane_max(*speed, lane_select(first, first_speed, zero));
  *speed = lane_max(*speed, lane_select(second, second_speed, zero));
}

SHARED_FN void contact_impacts_step(real* sums, ContactDepths earlier, ContactDepths before,
                                    ContactDepths middle, ContactDepths after, const Step* step) {
  real drive = sums[contact_impacts_drive];
  real back = sums[contact_impacts_back];
  real speed = sums[contact_impacts_period_speed];
  contact_impacts_see(earlier.drive, before.drive, middle.drive, after.drive, step, &drive, &speed);
  contact_impacts_see(earlier.back, before.back, middle.back, after.back, step, &back, &speed);
  sums[contact_impacts_drive] = drive;
  sums[contact_impacts_back] = back;
  sums[contact_impacts_period_speed] = speed;
  extrema_step(sums + contact_impacts_drive_depth, earlier.drive, before.drive, middle.drive,
               after.drive, step);
  extrema_step(sums + contact_impacts_back_depth, earlier.back, before.back, middle.back,
               after.back, step);
}

SHARED_FN void contact_impacts_end_period(real* sums, const Section* section) {
  const real speed = sums[contact_impacts_period_speed] / section->period;
  sums[contact_impacts_speed] = lane_max(sums[contact_impacts_speed], speed);
  sums[contact_impacts_period_speed] = 0;
}

SHARED_FN void contact_impacts_finish(const real* sums, SweepRound round, real* out) {
  const scalar periods = (scalar)(round.record);
  const real zero = 0;
  const real drive = sums[contact_impacts_drive];
  const real back = sums[contact_impacts_back];
  const real on_drive = sums[contact_impacts_drive_depth + extrema_max];
  const real on_back = sums[contact_impacts_back_depth + extrema_max];
  out[0] = drive / periods;
  out[1] = back / periods;
  out[2] = sums[contact_impacts_speed];
  out[3] =
      lane_max(lane_select(drive > zero, on_drive, zero), lane_select(back > zero, on_back, zero));
}
#endif
