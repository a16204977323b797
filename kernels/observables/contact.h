// Contact regime of the teeth: on the drive flank while D > b', on the back flank while D < -b', in
// the gap while neither, wedged while both, which takes a negative b'. Where a step crosses a
// limit, the shares of its time follow from the straight line between its ends.

#define CONTACT_ROLE measure
// The signals that a model must have for it.
#define CONTACT_SIGNALS(X) X(deflection) X(backlash)
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define CONTACT_OUTPUTS(X)                                            \
  X(drive, "1", "", "fraction of time on the drive flank alone")      \
  X(gap, "1", "", "fraction of time in the gap")                      \
  X(back, "1", "", "fraction of time on the back flank alone")        \
  X(wedged, "1", "", "fraction of time on both flanks at once")       \
  X(losses, "1", "", "contact losses (either flank left) per period") \
  X(class, "", "no_impact single_sided double_sided wedged",          \
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
enum { contact_outputs = CONTACT_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void contact_init(real* sums, const Moment* start) {
  sums[contact_drive] = 0;
  sums[contact_back] = 0;
  sums[contact_wedged] = 0;
  sums[contact_losses] = 0;
  sums[contact_gap_seen] = 0;
  sums[contact_min_backlash] = start->signals.backlash;
  sums[contact_period_drive] = 0;
  sums[contact_period_back] = 0;
  sums[contact_period_wedged] = 0;
}

// The share of a step during which a quantity that goes from a to b in a straight line is positive.
// It is exactly 1 where the quantity is positive throughout: on GPUs a float divided by itself may
// differ from 1.
SHARED_FN real contact_positive_share(real a, real b) {
  const real zero = 0;
  const real one = 1;
  const real total = lane_abs(a) + lane_abs(b);
  const real positive = lane_max(a, zero) + lane_max(b, zero);
  return lane_select(positive < total, positive / total, lane_select(total > zero, one, zero));
}

SHARED_FN void contact_step(real* sums, const Step* step) {
  const real zero = 0;
  const real one = 1;
  const Moment* before = step->before;
  const Moment* after = step->after;
  const scalar weight = step->weight;
  const real drive_before = before->signals.deflection - before->signals.backlash;
  const real drive_after = after->signals.deflection - after->signals.backlash;
  const real back_before = -before->signals.deflection - before->signals.backlash;
  const real back_after = -after->signals.deflection - after->signals.backlash;
  const real losses = lane_select((drive_before > zero) & (drive_after <= zero), one, zero) +
                      lane_select((back_before > zero) & (back_after <= zero), one, zero);
  const real drive = contact_positive_share(drive_before, drive_after);
  const real back = contact_positive_share(back_before, back_after);
  // Two shares at the same end of the step overlap in the shorter one; shares at opposite ends
  // overlap by what their sum exceeds 1.
  const mask apart = ((drive_before > zero) != (back_before > zero)) &
                     ((drive_after > zero) != (back_after > zero));
  const real excess = (drive + back) - one;
  const real both = lane_select(apart, lane_max(excess, zero), lane_min(drive, back));
  // Without a backlash a gap between the flanks is rounding.
  const mask open = lane_max(before->signals.backlash, after->signals.backlash) > zero;
  const real touching = (drive + back) - both;
  const mask gap = (touching <= zero) | (open & (touching < one));
  sums[contact_period_drive] += weight * (drive - both);
  sums[contact_period_back] += weight * (back - both);
  sums[contact_period_wedged] += weight * both;
  sums[contact_losses] += losses;
  sums[contact_gap_seen] = lane_select(gap, one, sums[contact_gap_seen]);
  // Both ends: a backlash may jump at a break phase.
  sums[contact_min_backlash] = lane_min(
      sums[contact_min_backlash], lane_min(before->signals.backlash, after->signals.backlash));
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
