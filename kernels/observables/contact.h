// Contact regime of the teeth: on the drive flank while D > b', on the back flank while D < -b', in
// the gap while neither, wedged while both, which takes a negative b'. A stop has the drive flank
// alone. What happens inside a step counts (contact_touch.h).

#define CONTACT_ROLE measure
#define CONTACT_PER_CONTACT
// X(suffix of the quantity's name, unit (/period: how often), flag meanings, meaning)
#define CONTACT_OUTPUTS(X)                                       \
  X(drive, "1", "", "fraction of time on the drive flank alone") \
  X(gap, "1", "", "fraction of time in the gap")                 \
  X(back, "1", "", "fraction of time on the back flank alone")   \
  X(wedged, "1", "", "fraction of time on both flanks at once")  \
  X(losses, "/period", "", "contact losses (either flank left)") \
  X(class, "", "no_impact single_sided double_sided wedged",     \
    "which flanks take part in impacts; wedged: b' is negative at times")

enum {
  contact_drive,
  contact_back,
  contact_wedged,
  contact_losses,
  contact_gap_seen,
  contact_min_backlash,
  contact_period_drive,
  contact_period_back,
  contact_period_wedged,
  contact_accumulators
};

#ifdef __OPENCL_VERSION__
#include "contact_touch.h"

enum { contact_outputs = CONTACT_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void contact_init(real* sums, ContactDepths start) {
  sums[contact_drive] = 0;
  sums[contact_back] = 0;
  sums[contact_wedged] = 0;
  sums[contact_losses] = 0;
  sums[contact_gap_seen] = 0;
  sums[contact_min_backlash] = start.backlash;
  sums[contact_period_drive] = 0;
  sums[contact_period_back] = 0;
  sums[contact_period_wedged] = 0;
}

// The share of a step during which a flank is touched, by its depth at the step's four moments;
// adds the contact losses.
SHARED_FN real contact_share(real earlier, real before, real middle, real after, real cubic,
                             real* losses) {
  const real zero = 0;
  const real one_half = (scalar)(0.5);
  const real one = 1;
  ContactTouch touch;
  const bool is_touched = contact_touch(earlier, before, middle, after, cubic, &touch);
  const real whole = lane_select(touch.on_before, one, zero);
  if (!is_touched) return whole;
  const real end = lane_select(touch.in_first, touch.first, touch.turn);  // of what began the step
  const real begin = lane_select(touch.in_second, touch.second, one);     // of what ends it
  const real on_first = lane_select(touch.on_before, end + one, zero);
  const real on_middle = lane_select(touch.on_turn, begin - end, zero);
  const real on_last = lane_select(touch.on_after, one - begin, zero);
  *losses = *losses + lane_select(touch.changes & touch.in_first & touch.on_before, one, zero) +
            lane_select(touch.changes & touch.in_second & touch.on_turn, one, zero);
  const real share = one_half * (on_first + on_middle + on_last);
  return lane_select(touch.changes & (touch.in_first | touch.in_second), share, whole);
}

SHARED_FN void contact_step(real* sums, ContactDepths earlier, ContactDepths before,
                            ContactDepths middle, ContactDepths after, const Step* step) {
  const real zero = 0;
  const real one = 1;
  const Share weight = step->weight;
  real losses = 0;
  const real drive =
      contact_share(earlier.drive, before.drive, middle.drive, after.drive, step->cubic, &losses);
  const real back =
      contact_share(earlier.back, before.back, middle.back, after.back, step->cubic, &losses);
  // Two shares at the same end of the step overlap in the shorter one; shares at opposite ends
  // overlap by what their sum exceeds 1.
  const mask apart = ((before.drive > zero) != (before.back > zero)) &
                     ((after.drive > zero) != (after.back > zero));
  const real excess = (drive + back) - one;
  const real both = lane_select(apart, lane_max(excess, zero), lane_min(drive, back));
  // Without a backlash a gap between the flanks is rounding.
  const mask open = lane_max(before.backlash, after.backlash) > zero;
  const real touching = (drive + back) - both;
  const mask gap = (touching <= zero) | (open & (touching < one));
  sums[contact_period_drive] += weight * (drive - both);
  sums[contact_period_back] += weight * (back - both);
  sums[contact_period_wedged] += weight * both;
  sums[contact_losses] += step->once * losses;
  sums[contact_gap_seen] = lane_select(gap, one, sums[contact_gap_seen]);
  // Both ends: a backlash may jump at a break phase.
  sums[contact_min_backlash] =
      lane_min(sums[contact_min_backlash], lane_min(before.backlash, after.backlash));
}

// Sums over one period first, so that many short shares keep their digits in fp32.
SHARED_FN void contact_end_period(real* sums, const Section* section) {
  sums[contact_drive] += sums[contact_period_drive];
  sums[contact_back] += sums[contact_period_back];
  sums[contact_wedged] += sums[contact_period_wedged];
  sums[contact_period_drive] = 0;
  sums[contact_period_back] = 0;
  sums[contact_period_wedged] = 0;
}

// Class 0: one region all the time; 1: one flank is left and met again; 2: both flanks are met; 3:
// the backlash was negative. Where it never was, both flanks touch by rounding only.
SHARED_FN void contact_finish(const real* sums, SweepRound round, real* out) {
  const scalar periods = (scalar)(round.record);
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real three = 3;
  const mask negative = sums[contact_min_backlash] < zero;
  const real drive = sums[contact_drive] / periods;
  const real back = sums[contact_back] / periods;
  const real wedged = lane_select(negative, sums[contact_wedged] / periods, zero);
  const real single =
      lane_select(((drive > zero) | (back > zero)) & (sums[contact_gap_seen] > zero), one, zero);
  out[0] = drive;
  out[1] = lane_max(one - drive - back - wedged, zero) * sums[contact_gap_seen];
  out[2] = back;
  out[3] = wedged;
  out[4] = sums[contact_losses] / periods;
  out[5] = lane_select(negative, three, lane_select((drive > zero) & (back > zero), two, single));
}
#endif
