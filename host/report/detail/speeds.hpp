// Speeds and frequencies of a report, in rpm and Hz where the study has scales.
#pragma once

#include <string>
#include <vector>

#include "report/detail/findings.hpp"

namespace gearsweep {

// A natural frequency that one or several modes have.
struct ReportMode {
  double frequency = 0.0;  // in the model's unit
  double damping = 0.0;
  std::size_t count = 1;
};

// At the first of the speeds; equal ones together.
std::vector<ReportMode> distinct_modes(const ReportFindings& findings);

// "1920 Hz" or "0.5 ϖ". HTML.
std::string frequency_html(const ReportFindings& findings, double frequency);

// A mesh frequency as the speed that makes it: "2970 rpm", or as itself. HTML.
std::string speed_html(const ReportFindings& findings, double forcing);

// Orders of the excitation that a report looks at.
struct ExcitationOrder {
  std::string name;
  double order = 1.0;
};
const std::vector<ExcitationOrder>& excitation_orders();

// Which order is near which natural frequency at this mesh frequency: "order 2 of 1920 Hz"; empty
// where none is within a twentieth. HTML.
std::string resonance_html(const ReportFindings& findings, double forcing);

}  // namespace gearsweep
