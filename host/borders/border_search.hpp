// Explains the borders of a map: finds the bifurcations that lie between neighbouring pixels,
// follows their curves through the plane of the map's two parameters, and tells of all other pairs
// what their motions do.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "borders/border_curve.hpp"
#include "borders/border_setting.hpp"
#include "borders/edge_reasons.hpp"
#include "study/study.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct BorderFindings {
  Study study;
  std::size_t steps = 0;  // of a forcing period
  PlanePlace ranges{};    // of the window
  std::vector<BorderCurve> curves;
  std::vector<ExplainedBorder> borders;  // the longest first
  ContactPairs contacts;                 // of a map that has the contact
  double seconds = 0.0;                  // in all
};

struct BorderRequest {
  PeriodPixels pixels;
  std::size_t min_edges = 10;  // of a border that is looked at
  std::size_t steps = 0;       // minimum of a forcing period; 0: kBorderSteps, or the study's
  // Told now and then how far the search has come.
  std::function<void(const std::string&)> tell = {};
};

// study: that of the map, with the step that it was computed with. Of `options`, the first device,
// the scheduler, stop, journal_path and notes are used; nothing when stopped. A journal stays when
// it returns: delete it once the curves are in a safe place. Throws InputError as
// make_border_setting() does, RunError when the device fails.
std::optional<BorderFindings> find_borders(const Study& study, const BorderRequest& request,
                                           const SweepOptions& options);

}  // namespace gearsweep
