#include "cli/detail/pilot_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace gearsweep {

namespace {

std::string describe_pilot(const PilotFindings& pilot) {
  const std::string found =
      pilot.sensitive > 0.0 ? fmt::format("{:.1f} % land", 100.0 * pilot.sensitive) : "none lands";
  return fmt::format(
      "at most {:.4g}{}: maps keep the tolerance at {:.1f} % or more of the periodic points (95 % "
      "confidence, {} judged), and {:.1g} of their range at 99 % of those judged; {} elsewhere at "
      "any change of the step, up to {:.1f} % of all may\n",
      pilot.step.max_step, pilot.step.words_of_orbits(), std::floor(1e3 * pilot.kept) / 10.0,
      pilot.points, pilot.error, found, std::ceil(1e3 * pilot.max_sensitive) / 10.0);
}

}  // namespace

std::string describe_steps(const Study& study, const std::optional<PilotFindings>& pilot) {
  if (pilot) return describe_pilot(*pilot);
  if (study.step_reason.empty()) return "";
  return fmt::format("at most {:.4g}, found for a model without max_step: {}\n",
                     study.integrate.max_step, study.step_reason);
}

std::string describe_clock(const Study& study) {
  if (study.clock_reason.empty()) return "";
  const double clock = study.model->binding.clock;
  return fmt::format(
      "periods of {:.4g}, for a model without forcing: {}; the record is {:.4g} long\n", clock,
      study.clock_reason, clock * static_cast<double>(study.integrate.record));
}

nlohmann::json pilot_as_json(const PilotFindings& pilot) {
  return {{"max_step", pilot.step.max_step},
          {"orbit_steps", pilot.step.orbit_steps},
          {"error", pilot.error},
          {"errors", pilot.errors},
          {"kept", pilot.kept},
          {"sensitive", pilot.sensitive},
          {"sensitive_max", pilot.max_sensitive},
          {"points", pilot.points}};
}

}  // namespace gearsweep
