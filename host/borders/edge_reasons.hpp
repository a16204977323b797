// What parts neighbouring pixels of different periods.
#pragma once

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
};
inline constexpr std::size_t kEdgeReasons = 4;

// "a curve", "a change of basin", ...
std::string describe(EdgeReason reason);

struct ExplainedBorder {
  MapBorder border;
  std::vector<EdgeReason> reasons;  // [edge]

  std::size_t count(EdgeReason reason) const;
};

// Of pairs without a curve: whether an orbit of the two goes on, stable, to the other pixel and one
// pixel beyond it. Throws SearchStopped.
void explain_without_curves(const ParameterPlane& plane, const PeriodPixels& pixels, OrbitMap* map,
                            SettledPixels* settled, std::vector<ExplainedBorder>* borders);

}  // namespace gearsweep
