// Distances between states, relative to the ranges of the motion.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace gearsweep {

// (a - b) / ranges, where angles differ by half a turn at most. ranges must not be 0.
inline Eigen::VectorXd relative_difference(std::span<const double> a, std::span<const double> b,
                                           const std::vector<double>& ranges,
                                           const std::vector<std::size_t>& angles) {
  const auto states = static_cast<Eigen::Index>(ranges.size());
  Eigen::VectorXd apart = Eigen::Map<const Eigen::VectorXd>(a.data(), states) -
                          Eigen::Map<const Eigen::VectorXd>(b.data(), states);
  for (const std::size_t angle : angles) {
    double& turn = apart[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  apart.array() /= Eigen::Map<const Eigen::ArrayXd>(ranges.data(), states);
  return apart;
}

}  // namespace gearsweep
