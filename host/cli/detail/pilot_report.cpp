#include "cli/detail/pilot_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace gearsweep {

std::string describe_pilot(const PilotFindings& pilot) {
  std::string text = fmt::format(
      "at most {:.4g}: maps right to {:.1g} of their range at 99 % of {} periodic points",
      pilot.step, pilot.error, pilot.points);
  if (pilot.sensitive > 0.0) {
    text +=
        fmt::format("; {:.1f} % land elsewhere at any change of the step", 100.0 * pilot.sensitive);
  }
  return text + '\n';
}

nlohmann::json pilot_as_json(const PilotFindings& pilot) {
  return {{"max_step", pilot.step},
          {"error", pilot.error},
          {"errors", pilot.errors},
          {"sensitive", pilot.sensitive},
          {"points", pilot.points}};
}

}  // namespace gearsweep
