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
#include "borders/map_borders.hpp"
#include "study/study.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// What parts two neighbouring pixels of different periods.
enum class EdgeReason {
  curve,      // a curve passes between them, within half a pixel of the middle, and a stable
              // motion of theirs bifurcates there
  basin,      // the orbit of one goes on beyond the other, stable: they start in different basins
  lost,       // the orbit loses its stability or ends between them, and no curve was found there
  unsettled,  // neither motion was found again
};
inline constexpr std::size_t kEdgeReasons = 4;

// "a curve", "a change of basin", ...
std::string describe(EdgeReason reason);

struct ExplainedBorder {
  MapBorder border;
  std::vector<EdgeReason> reasons;  // [edge]

  std::size_t count(EdgeReason reason) const;
};

struct BorderFindings {
  Study study;
  std::size_t steps = 0;  // of a forcing period
  std::vector<BorderCurve> curves;
  std::vector<ExplainedBorder> borders;  // the longest first
  double seconds = 0.0;                  // in all
};

struct BorderRequest {
  PeriodPixels pixels;
  std::size_t min_edges = 10;  // of a border that is looked at
  std::size_t steps = 0;       // minimum of a forcing period; 0: kBorderSteps, or the study's
  // Told now and then how far the search has come.
  std::function<void(const std::string&)> tell = {};
};

inline constexpr std::size_t kBorderSteps = 512;

// study: that of the map, with the step that it was computed with. Of `options`, the first device,
// the scheduler and stop are used; nothing when stopped. Throws InputError for a map that has no
// plane of two parameters, RunError when the device fails.
std::optional<BorderFindings> find_borders(const Study& study, const BorderRequest& request,
                                           const SweepOptions& options);

}  // namespace gearsweep
