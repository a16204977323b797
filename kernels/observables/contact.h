// Contact regime of the teeth: on the drive flank while D > b', on the back flank while D < -b', in
// the gap between. Where a step crosses a limit, the shares of its time follow from the straight
// line between its ends.

#define CONTACT_KIND step
// The signals that a model must have for it.
#define CONTACT_SIGNALS(X) X(deflection) X(backlash)
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define CONTACT_OUTPUTS(X)                                            \
  X(drive, "1", "", "fraction of time on the drive flank")            \
  X(gap, "1", "", "fraction of time in the gap")                      \
  X(back, "1", "", "fraction of time on the back flank")              \
  X(losses, "1", "", "contact losses (either flank left) per period") \
  X(class, "", "no_impact single_sided double_sided", "which flanks take part in impacts")

enum {
  contact_drive,
  contact_back,
  contact_losses,
  contact_gap_seen,
  contact_period_drive,
  contact_period_back,
  contact_accumulators
};

#ifdef __OPENCL_VERSION__
enum { contact_outputs = CONTACT_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void contact_init(real* sums, const Sample* start) {
  sums[contact_drive] = 0;
  sums[contact_back] = 0;
  sums[contact_losses] = 0;
  sums[contact_gap_seen] = 0;
  sums[contact_period_drive] = 0;
  sums[contact_period_back] = 0;
}

// The share of a step during which a quantity that goes from a to b in a straight line is positive.
SHARED_FN real contact_positive_share(real a, real b) {
  const real zero = 0;
  const real total = lane_abs(a) + lane_abs(b);
  const real positive = lane_max(a, zero) + lane_max(b, zero);
  return lane_select(total > zero, positive / total, zero);
}

SHARED_FN void contact_update(real* sums, const Sample* before, const Sample* after,
                              scalar weight) {
  const real zero = 0;
  const real one = 1;
  const real drive_before = before->signals.deflection - before->signals.backlash;
  const real drive_after = after->signals.deflection - after->signals.backlash;
  const real back_before = -before->signals.deflection - before->signals.backlash;
  const real back_after = -after->signals.deflection - after->signals.backlash;
  const real losses = lane_select((drive_before > zero) & (drive_after <= zero), one, zero) +
                      lane_select((back_before > zero) & (back_after <= zero), one, zero);
  sums[contact_period_drive] += weight * contact_positive_share(drive_before, drive_after);
  sums[contact_period_back] += weight * contact_positive_share(back_before, back_after);
  sums[contact_losses] += losses;
  sums[contact_gap_seen] =
      lane_select((drive_after <= zero) & (back_after <= zero), one, sums[contact_gap_seen]);
}

// Sums over one period first, so that many short shares keep their digits in fp32.
SHARED_FN void contact_period(real* sums) {
  sums[contact_drive] += sums[contact_period_drive];
  sums[contact_back] += sums[contact_period_back];
  sums[contact_period_drive] = 0;
  sums[contact_period_back] = 0;
}

// Class 0: one region all the time; 1: one flank is left and met again; 2: both flanks are met.
SHARED_FN void contact_finish(const real* sums, SweepRound round, real* out) {
  const scalar periods = (scalar)(round.record);
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real drive = sums[contact_drive] / periods;
  const real back = sums[contact_back] / periods;
  const real single =
      lane_select(((drive > zero) | (back > zero)) & (sums[contact_gap_seen] > zero), one, zero);
  out[0] = drive;
  out[1] = lane_max(one - drive - back, zero) * sums[contact_gap_seen];
  out[2] = back;
  out[3] = sums[contact_losses] / periods;
  out[4] = lane_select((drive > zero) & (back > zero), two, single);
}
#endif
