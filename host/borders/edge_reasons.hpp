// What parts neighbouring pixels of different periods.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "borders/map_borders.hpp"
#include "borders/settled_pixels.hpp"

namespace gearsweep {

// What parts two neighbouring pixels of different periods.
enum class EdgeReason {
  curve,      // a curve passes between them, within half a pixel of the middle, and a stable
              // motion of theirs bifurcates there
  basin,      // the orbit of one goes on beyond the other, stable: two motions are stable there
  lost,       // the orbit loses its stability or ends between them, and no curve was found there
  unsettled,  // neither motion was found again
  graze,      // the orbit is lost, and begins or ceases to touch a limit there
};
inline constexpr std::size_t kEdgeReasons = 5;
// How far from a pair's middle a curve may pass that explains it, in pixels.
inline constexpr double kHalfPixel = 0.5;

// "a curve", "a change of basin", ...
std::string describe(EdgeReason reason);

struct ExplainedBorder {
  MapBorder border;
  std::vector<EdgeReason> reasons;  // [edge]

  std::size_t count(EdgeReason reason) const;
};

// Pairs of neighbouring pixels of one period that differ in the contact, and those of them that a
// grazing curve of a stable motion passes between, within half a pixel of their middle.
struct ContactPairs {
  std::size_t pairs = 0, on_curve = 0;
};

// Whether a curve that a motion of the border bifurcates at passes within 1.5 pixels of the middle
// of one of its pairs: behind one of the two pixels, but not between them.
using CurveBeyond = std::function<bool(const MapBorder&, const BorderEdge&)>;

// Asks of pairs without a curve whether an orbit of the two goes on, stable, to the other pixel and
// one pixel beyond it, or to a curve on the way there. Throws SearchStopped.
void explain_without_curves(const ParameterPlane& plane, const PeriodPixels& pixels, OrbitMap* map,
                            SettledPixels* settled, const CurveBeyond& has_curve_beyond,
                            std::vector<ExplainedBorder>* borders);

}  // namespace gearsweep
