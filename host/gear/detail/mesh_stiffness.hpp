// The stiffness of the mesh: as given, as measured, or by ISO 6336-1.
#pragma once

#include <optional>

#include "gear/detail/geometry.hpp"
#include "gear/detail/measured_curve.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// By ISO 6336-1, how many times as stiff as one pair of teeth the mesh is in the mean, of a
// transverse contact ratio.
inline double pairs_in_mean(double contact_ratio) { return 0.75 * contact_ratio + 0.25; }

// The measured stiffness, if there is one, whose mean is above 0.
std::optional<MeasuredCurve> measured_stiffness(const GearDrawing& drawing);

// Mean mesh stiffness k0 in N/m, as given or from the face width: ISO 6336-1, method B, for steel
// (theoretical single stiffness 1/q', model factor 0.8, basic rack factor C_B, helix factor
// cos(beta)). Without either, the mean of what was measured, if that is above 0. Throws
// DrawingError.
double mean_mesh_stiffness(const GearDrawing& drawing, const GearGeometry& geometry,
                           double contact_ratio, double measured, GearTarget* target);

// The curves of a measured stiffness over k0, if there is one. Throws DrawingError.
void add_stiffness(const GearDrawing& drawing, const std::optional<MeasuredCurve>& stiffness,
                   double k0, GearTarget* target);

}  // namespace gearsweep
