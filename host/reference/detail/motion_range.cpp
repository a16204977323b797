#include "reference/detail/motion_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace gearsweep {

MotionRange::MotionRange(StateKinds kinds, double tolerance)
    : kinds_(std::move(kinds)), min_(64.0 * std::numeric_limits<double>::epsilon() / tolerance) {}

void MotionRange::widen(const Eigen::VectorXd& state) {
  low_ = low_.cwiseMin(state);
  high_ = high_.cwiseMax(state);
}

Eigen::VectorXd MotionRange::end_period(const Eigen::VectorXd& state) {
  const Eigen::VectorXd max = low_.cwiseAbs().cwiseMax(high_.cwiseAbs());
  const Eigen::VectorXd range = (high_ - low_).cwiseMax(min_ * max);
  if (ranges_.size() == 0) ranges_ = Eigen::VectorXd::Zero(range.size());
  ranges_ = ranges_.cwiseMax(range);
  begin(state);
  return range;
}

double MotionRange::distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& ranges) const {
  Eigen::VectorXd apart = a - b;
  for (const std::size_t angle : kinds_.angles) {
    double& turn = apart[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return size(apart, ranges);
}

double MotionRange::size(const Eigen::VectorXd& apart, const Eigen::VectorXd& ranges) const {
  double max = 0.0;
  for (std::size_t i = 0; i < kinds_.groups.size(); ++i) {
    const double size = std::abs(apart[static_cast<Eigen::Index>(i)]);
    if (size == 0.0) continue;
    double range = 0.0;
    for (std::size_t j = 0; j < kinds_.groups.size(); ++j) {
      if (kinds_.groups[j] != kinds_.groups[i]) continue;
      range = std::max(range, ranges[static_cast<Eigen::Index>(j)]);
    }
    max = std::max(max, size / range);
  }
  return max;
}

}  // namespace gearsweep
