#include "gear/detail/measured_curve.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace gearsweep {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

// Gauss's three points between neighbours: right for a cubic.
double mean_of(const PeriodicTable& table, const std::vector<TablePoint>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double from = points[i].phase;
    const double to =
        i + 1 < points.size() ? points[i + 1].phase : points.front().phase + kWholeTurn;
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    if (half == 0.0) continue;
    const double reach = half * std::sqrt(0.6);
    sum += half / 9.0 *
           (5.0 * table.at(middle - reach, middle) + 8.0 * table.at(middle, middle) +
            5.0 * table.at(middle + reach, middle));
  }
  return sum / kWholeTurn;
}

}  // namespace

std::shared_ptr<const PeriodicTable> MeasuredCurve::in(double unit) const {
  return std::make_shared<const PeriodicTable>(table->times(1.0 / unit));
}

std::optional<MeasuredCurve> measured_curve(const GearDrawing& drawing, const GearKey& key,
                                            Interpolation interpolation) {
  const Measured* measured = drawing.measured(key);
  if (measured == nullptr) return std::nullopt;
  try {
    MeasuredCurve curve{
        std::make_shared<const PeriodicTable>(measured->source, measured->points, interpolation),
        0.0};
    curve.mean = mean_of(*curve.table, measured->points);
    return curve;
  } catch (const InputError& error) {
    throw DrawingError(key, error.what());
  }
}

Interpolation stiffness_interpolation(const GearDrawing& drawing) {
  return drawing.choice(kInterpolation) == "cubic" ? Interpolation::cubic : Interpolation::linear;
}

double value_over_path(const std::vector<TablePoint>& points, double place) {
  const auto after = std::ranges::upper_bound(points, place, {}, &TablePoint::phase);
  if (after == points.begin()) return points.front().value;
  if (after == points.end()) return points.back().value;
  const TablePoint &left = *(after - 1), &right = *after;
  return left.value +
         (right.value - left.value) * (place - left.phase) / (right.phase - left.phase);
}

std::vector<Harmonic> harmonics_of(const std::function<double(double)>& value, std::size_t count) {
  constexpr std::size_t kSamples = 4096;
  std::vector<Harmonic> harmonics;
  for (std::size_t order = 1; order <= count; ++order) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double angle = kWholeTurn * static_cast<double>(i) / kSamples;
      sum += value(angle) * std::polar(1.0, -angle * static_cast<double>(order));
    }
    // |c| cos(n x + arg c) = |c| sin(n x + arg c + pi/2)
    harmonics.push_back({2.0 / kSamples * std::abs(sum), std::arg(sum) + 0.5 * std::numbers::pi});
  }
  return harmonics;
}

}  // namespace gearsweep
