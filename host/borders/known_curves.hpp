// The curves that a search has found so far. Threads may share them.
#pragma once

#include <mutex>
#include <vector>

#include "borders/border_curve.hpp"
#include "borders/curve_distance.hpp"

namespace gearsweep {

class KnownCurves {
 public:
  // The pixels must outlive it.
  explicit KnownCurves(const PeriodPixels& pixels) : pixels_(pixels) {}

  // Whether a point lies on a curve of its kind.
  bool has(const BorderEquations& equations, const BorderPoint& point);
  // Whether a grazing curve of this period passes a place within so many pixels.
  bool grazes_near(std::size_t period, const PlanePlace& place, double pixels);
  // Adds a curve; its line in pixels, or nothing where it is no curve or lies on others: another
  // search may have found it, or it was begun elsewhere.
  std::optional<PixelLine> add(BorderCurve curve);

  std::size_t size();
  // Once no thread adds any more.
  const std::vector<BorderCurve>& curves() const { return curves_; }
  const std::vector<PixelLine>& lines() const { return lines_; }
  std::vector<BorderCurve> take() { return std::move(curves_); }

 private:
  // With the mutex held. of: what it is a point of.
  bool is_on_one(const BorderCurve& of, const BorderPoint& point) const;

  const PeriodPixels& pixels_;
  std::mutex mutex_;
  std::vector<BorderCurve> curves_;
  std::vector<PixelLine> lines_;  // [curve]
};

}  // namespace gearsweep
