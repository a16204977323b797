// What a report says first: the worst speed, contact, the speed in use.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/detail/findings.hpp"

namespace gearsweep {

// A speed, of the sweep or of one of the two runs through it.
struct WorstSpeed {
  std::string file;       // "line.nc", "up.nc", "down.nc"
  std::size_t point = 0;  // over the speed
  double value = 0.0;     // of what ranks the speeds
  bool is_edge = false;   // of the speeds: beyond it there may be more
};

// Where the force is largest, or vibrates most (ReportFindings::ranking). A run through the speeds
// counts where it has clearly more than the sweep: it goes on with motions that the sweep may not
// come to. Nothing where no speed has a value.
std::optional<WorstSpeed> find_worst(const ReportFindings& findings);

// The place of the largest number; nothing where there is none.
std::optional<std::size_t> largest_of(const std::vector<double>& values);

// The share of the time that some contact is open, at each speed of a file; empty where the model
// has none.
std::vector<double> time_apart(const ReportFindings& findings, const std::string& file);

// The mesh frequency of the speed in use, where the drawing has it (pinion_speed_rpm).
std::optional<double> used_forcing(const ReportFindings& findings);

// A sentence that answers, and what goes with it. HTML.
std::string answer_html(const ReportFindings& findings);
std::vector<std::string> remarks_html(const ReportFindings& findings);

}  // namespace gearsweep
