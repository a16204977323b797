// What was measured over a mesh period or the path of contact, and the harmonics of such a curve.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "expression/periodic_table.hpp"
#include "gear/drawing.hpp"

namespace gearsweep {

// A curve over a mesh period, whose phase is in radians.
struct MeasuredCurve {
  std::shared_ptr<const PeriodicTable> table;
  double mean = 0.0;
  // The curve divided by `unit`.
  std::shared_ptr<const PeriodicTable> in(double unit) const;
};

// Nothing where the drawing has no such key. Throws DrawingError.
std::optional<MeasuredCurve> measured_curve(const GearDrawing& drawing, const GearKey& key,
                                            Interpolation interpolation);

// What is between the points of the curves of stiffness.
Interpolation stiffness_interpolation(const GearDrawing& drawing);

// A curve over the path of contact, 0 to 1: straight between its points, level before the first and
// behind the last.
double value_over_path(const std::vector<TablePoint>& points, double place);

// A line amplitude sin(order angle + phase) of the series of a curve.
struct Harmonic {
  double amplitude = 0.0, phase = 0.0;  // rad
};

// The first so many harmonics of a function of an angle; the mean is left out.
std::vector<Harmonic> harmonics_of(const std::function<double(double)>& value, std::size_t count);

}  // namespace gearsweep
