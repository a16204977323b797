#include "borders/known_curves.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

constexpr double kOnCurve = 0.05;      // pixels
constexpr double kNearlyAll = 0.9;     // points of a curve that lie on others: it is one of them
constexpr std::size_t kMinPoints = 4;  // of a curve

}  // namespace

bool KnownCurves::is_on_one(const BorderCurve& of, const BorderPoint& point) const {
  const PixelPlace at = pixel_place(pixels_, point.place);
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const bool is_alike = curves_[i].kind == of.kind && curves_[i].period == of.period &&
                          curves_[i].limit == of.limit;
    if (is_alike && lines_[i].distance_to(at) <= kOnCurve) return true;
  }
  return false;
}

bool KnownCurves::has(const BorderEquations& equations, const BorderPoint& point) {
  BorderCurve of;
  of.kind = equations.kind();
  of.period = equations.period();
  of.limit = equations.limit();
  const std::lock_guard lock(mutex_);
  return is_on_one(of, point);
}

bool KnownCurves::grazes_near(std::size_t period, const PlanePlace& place, double pixels) {
  const PixelPlace at = pixel_place(pixels_, place);
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const bool is_alike = curves_[i].kind == BorderKind::grazing && curves_[i].period == period;
    if (is_alike && lines_[i].distance_to(at) <= pixels) return true;
  }
  return false;
}

std::optional<PixelLine> KnownCurves::add(BorderCurve curve) {
  // Fewer points: Newton's method came to a place around which the equations have no curve.
  if (curve.points.size() < kMinPoints) return std::nullopt;
  PixelLine line(pixels_, curve);
  const std::lock_guard lock(mutex_);
  if (is_on_one(curve, curve.points[curve.start])) return std::nullopt;
  const auto known = std::ranges::count_if(
      curve.points, [&](const BorderPoint& point) { return is_on_one(curve, point); });
  if (static_cast<double>(known) > kNearlyAll * static_cast<double>(curve.points.size())) {
    return std::nullopt;
  }
  curves_.push_back(std::move(curve));
  lines_.push_back(line);
  return line;
}

std::size_t KnownCurves::size() {
  const std::lock_guard lock(mutex_);
  return curves_.size();
}

}  // namespace gearsweep
