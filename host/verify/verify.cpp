#include "verify/verify.hpp"

#include "model/error.hpp"
#include "verify/detail/check_list.hpp"

namespace gearsweep {

const std::vector<Check>& checks() {
  static const std::vector<Check> kAll = {
      {"linear oscillator", "fp64 against the closed form", true, compare_oscillator_fp64},
      {"same bits", "the kernel against the same formula on the host, gear5 with impacts", true,
       compare_bits},
      {"reference orbits", "gear5 against two independent programs", true, compare_orbits_fp64},
      {"engines agree", "gear5 with impacts, by the kernel and by the reference engine", true,
       compare_engines_fp64},
      {"exponent sum", "all Lyapunov exponents of gear5 against the mean trace", true,
       compare_exponent_sum},
      {"published exponents", "Ueda's oscillator against Sprott 2003", true,
       compare_published_exponents},
      {"multipliers", "of gear5's orbits with impacts, against an outside integration", true,
       compare_multipliers},
      {"default step", "van der Pol's oscillator against Sprott 2003", true, compare_default_step},
      {"periods", "linear oscillators on their slow way to period 1", true, compare_periods},
      {"stopped points", "trajectories that pass near orbits that they do not go to", true,
       compare_stopped_points},
      {"linear oscillator, fp32", "the same as above", false, compare_oscillator_fp32},
      {"reference orbits, fp32", "the same as above", false, compare_orbits_fp32},
      {"engines agree, fp32", "the same as above; the reference engine computes in fp64", false,
       compare_engines_fp32},
      {"file and back", "a map written, read and computed again from the file's own study", false,
       compare_file},
  };
  return kAll;
}

Outcome judge(const std::vector<Compared>& compared) {
  Outcome outcome;
  outcome.numbers = compared.size();
  for (const Compared& one : compared) {
    if (!one.holds()) ++outcome.failed;
    if (!outcome.worst || one.share_of_tolerance() > outcome.worst->share_of_tolerance())
      outcome.worst = one;
  }
  outcome.verdict = outcome.failed == 0 && outcome.numbers > 0 ? Verdict::pass : Verdict::fail;
  if (outcome.numbers == 0) outcome.reason = "nothing was compared";
  return outcome;
}

Outcome carry_out(const Check& check, const Subject& subject) {
  Outcome outcome;
  if (check.needs_fp64 && !subject.fp64) {
    outcome.reason = "the device has no fp64";
    return outcome;
  }
  try {
    return judge(check.compare(subject));
  } catch (const RunError& error) {
    outcome.verdict = Verdict::fail;
    outcome.reason = error.what();
    return outcome;
  }
}

}  // namespace gearsweep
