#include "borders/curve_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearsweep {
namespace {

// Between two values of the axis, or beyond its ends as between the last two.
double column_of(const std::vector<double>& axis, bool is_logarithmic, double value) {
  if (axis.size() < 2) return 0.0;
  const auto above = std::ranges::upper_bound(axis, value) - axis.begin();
  const auto low = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(axis.size()) - 2));
  const double a = axis[low], b = axis[low + 1];
  const double share =
      is_logarithmic ? std::log(value / a) / std::log(b / a) : (value - a) / (b - a);
  return static_cast<double>(low) + share;
}

double distance_to_line(const PixelPlace& a, const PixelPlace& b, const PixelPlace& place) {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double length = dx * dx + dy * dy;
  double share = 0.0;
  if (length > 0.0) {
    share = std::clamp(((place[0] - a[0]) * dx + (place[1] - a[1]) * dy) / length, 0.0, 1.0);
  }
  return std::hypot(place[0] - a[0] - share * dx, place[1] - a[1] - share * dy);
}

}  // namespace

PixelPlace pixel_place(const PeriodPixels& pixels, const PlanePlace& place) {
  return {column_of(pixels.axes[0], pixels.is_logarithmic[0], place[0]),
          column_of(pixels.axes[1], pixels.is_logarithmic[1], place[1])};
}

PixelPlace middle_of(const PeriodPixels& pixels, const BorderEdge& edge) {
  PixelPlace out{};
  for (const std::size_t pixel : edge.pixels) {
    const std::size_t column = pixel % pixels.columns(), row = pixel / pixels.columns();
    out[0] += 0.5 * static_cast<double>(column);
    out[1] += 0.5 * static_cast<double>(row);
  }
  return out;
}

PixelLine::PixelLine(const PeriodPixels& pixels, const BorderCurve& curve) {
  for (const BorderPoint& point : curve.points) {
    places_.push_back(pixel_place(pixels, point.place));
    // A graze is followed from where a motion that settles comes up to it, while it hardly gets
    // more unstable.
    is_stable_.push_back(curve.kind == BorderKind::grazing || point.is_of_stable_motion());
  }
}

double PixelLine::distance_to(const PixelPlace& place, bool of_stable) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    if (of_stable && !(is_stable_[i] && is_stable_[i + 1])) continue;
    nearest = std::min(nearest, distance_to_line(places_[i], places_[i + 1], place));
  }
  return nearest;
}

}  // namespace gearsweep
