#include "verify/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "model/error.hpp"
#include "sweep/sweep.hpp"
#include "verify/detail/check_list.hpp"

namespace gearsweep {
namespace {

std::size_t count_of(const std::vector<CheckReport>& reports, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(reports.begin(), reports.end(),
                    [&](const CheckReport& report) { return report.outcome.verdict == verdict; }));
}

}  // namespace

Subject make_subject(const DeviceInfo& device, const SweepOptions& options) {
  const auto compute = [options](const Study& study) {
    std::optional<SweepResult> result = run_sweep(study, options);
    if (!result) throw RunError("interrupted");
    return *std::move(result);
  };
  return {compute, device.fp64, device.is_cpu};
}

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
      {"published exponents", "Duffing's oscillator against Sprott 2003", true,
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
       compare_file, true},
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
  } catch (const std::exception& error) {  // of a device, a disk, a folder that is not there
    outcome.verdict = Verdict::fail;
    outcome.reason = error.what();
    return outcome;
  }
}

CheckReport carry_out_timed(const Check& check, const Subject& subject) {
  const auto start = std::chrono::steady_clock::now();
  CheckReport report{&check, carry_out(check, subject), 0.0};
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  report.seconds = spent.count();
  return report;
}

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::skipped:
      break;
  }
  return "skipped";
}

std::string figures_of(const Outcome& outcome) {
  if (!outcome.reason.empty()) return outcome.reason;
  const std::string count = outcome.failed > 0 ? fmt::format("{} of {} numbers are wrong",
                                                             outcome.failed, outcome.numbers)
                                               : fmt::format("{} numbers", outcome.numbers);
  return fmt::format("{}; {}", count, describe(*outcome.worst));
}

std::string verdict_of(const std::vector<CheckReport>& reports) {
  const std::size_t failed = count_of(reports, Verdict::fail);
  const std::size_t skipped = count_of(reports, Verdict::skipped);
  std::string text = failed > 0
                         ? fmt::format("FAIL: {} of {} checks failed", failed, reports.size())
                         : fmt::format("pass: {} checks", reports.size() - skipped);
  if (skipped > 0) text += fmt::format(", {} skipped", skipped);
  return text;
}

}  // namespace gearsweep
