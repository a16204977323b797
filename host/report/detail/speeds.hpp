// Speeds and frequencies of a report, in rpm and Hz where the study has scales.
#pragma once

#include <optional>
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
  std::string name;    // "1/2", or "1/2 of second" where there are several meshes
  double order = 1.0;  // of the frequency of the phase
  bool is_half = false;
};
std::vector<ExcitationOrder> excitation_orders(const ReportFindings& findings);

// What the orange and the violet lines of an order map are: "dotted: orders of the mesh frequency",
// or where there are two meshes which of them are whose. HTML.
std::string rays_html(const ReportFindings& findings);

// A speed at which one of these orders meets a natural frequency.
struct CriticalSpeed {
  double forcing = 0.0;    // the mesh frequency there
  double frequency = 0.0;  // the natural one
  ExcitationOrder order;

  // How far it lies above another mesh frequency, as a share of that.
  double margin(double from) const { return forcing / from - 1.0; }
  // "order 2 of 1920 Hz", of several meshes "order 2 of second at 1920 Hz". HTML.
  std::string html(const ReportFindings& findings) const;
};

// The nearest to a mesh frequency, with the half orders or without, and of the whole orders the
// nearest above it by more than `near` of it.
std::optional<CriticalSpeed> nearest_critical(const ReportFindings& findings, double forcing,
                                              bool with_halves);
std::optional<CriticalSpeed> next_critical(const ReportFindings& findings, double forcing,
                                           double near);

// Two speeds that differ by less than this share are near each other.
inline constexpr double kNearSpeeds = 0.05;

// Which order is near which natural frequency at this mesh frequency: "order 2 of 1920 Hz, 1.2 %
// below"; empty where none is near. HTML.
std::string resonance_html(const ReportFindings& findings, double forcing);

// How far a critical speed is from one, in words: "3.1 % higher". HTML.
std::string margin_html(const CriticalSpeed& critical, double from);

}  // namespace gearsweep
