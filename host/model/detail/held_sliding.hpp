// What the parts of a held field share.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "model/held_field.hpp"

namespace gearsweep {
namespace held {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr double kNear = 1e-9;         // of what a level changes in a step
inline constexpr double kRounding = 1.8e-15;  // 8 roundings

inline Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace held

// The field without what keeps the motion at its surfaces, what that adds for each surface, and how
// much of it there must be.
struct HeldField::Sliding {
  std::vector<std::size_t> surfaces;
  Eigen::VectorXd base, share;
  Eigen::MatrixXd turn, gain;  // [state][surface], [held value][surface]
  held::RowMajor gradients;    // of what is held
  // The share of a jump that holds what a surface holds that the motion rests against, as dry
  // friction does of a mass at a wall. What each of them does cannot be told; the wall lets the
  // mass go on one side alone, and the jump is on that side.
  std::vector<std::optional<double>> bound;

  Eigen::VectorXd field() const { return base + turn * share; }
  // What gain times the result is, row by row, but for what is bound: that is 0. Where no turn
  // changes what is held, as where both sides have the same field, it is no number.
  Eigen::MatrixXd solve_any(Eigen::MatrixXd wanted) const {
    Eigen::MatrixXd left = gain;
    for (std::size_t i = 0; i < bound.size(); ++i) {
      if (!bound[i]) continue;
      left.row(held::index(i)) =
          Eigen::MatrixXd::Identity(left.rows(), left.cols()).row(held::index(i));
      wanted.row(held::index(i)).setZero();
    }
    return left.partialPivLu().solve(wanted);
  }
  // The same; 0 there.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& wanted) const {
    return solve_any(wanted).unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
  }
};

}  // namespace gearsweep
