#include "borders/border.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

// Steps of differences, in scaled unknowns. They steer the iteration and are no part of what it
// converges to.
constexpr double kDifference = 1e-6;
constexpr double kResidual = 1e-10;
// A residual that no step makes smaller is rounding, if it is at most this.
constexpr double kRounding = 1e-8;
constexpr double kBetter = 0.5;
constexpr int kMaxIterations = 12;

MatrixXcd less_multiplier(const MatrixXd& monodromy, double angle) {
  MatrixXcd out = monodromy.cast<std::complex<double>>();
  out.diagonal().array() -= std::polar(1.0, angle);
  return out;
}

// The bordered matrix's last column and row: what it maps to 1 beside zeros.
struct Bordered {
  VectorXcd left, right;
  std::complex<double> value;  // 0 where the matrix is singular
};

Bordered solve_bordered(const MatrixXcd& matrix, const NullVectors& near) {
  const Index n = matrix.rows();
  MatrixXcd bordered(n + 1, n + 1);
  bordered << matrix, near.left, near.right.adjoint(), 0.0;
  const Eigen::FullPivLU<MatrixXcd> solver(bordered);
  const VectorXcd unit = VectorXcd::Unit(n + 1, n);
  const VectorXcd right = solver.solve(unit);
  const VectorXcd left = Eigen::FullPivLU<MatrixXcd>(bordered.adjoint()).solve(unit);
  return {left.head(n), right.head(n), right[n]};
}

}  // namespace

std::string name_of(BorderKind kind) {
  switch (kind) {
    case BorderKind::fold:
      return "fold";
    case BorderKind::flip:
      return "flip";
    case BorderKind::neimark_sacker:
      break;
  }
  return "Neimark-Sacker";
}

BorderEquations::BorderEquations(const ParameterPlane& plane, OrbitMap* map, BorderKind kind,
                                 std::size_t period, BorderScale scale)
    : plane_(plane), map_(map), kind_(kind), period_(period), scale_(std::move(scale)) {}

VectorXd BorderEquations::unknowns_of(const BorderPoint& point) const {
  VectorXd out(unknowns());
  out.head(states()) = point.state.cwiseQuotient(scale_.sizes);
  if (has_angle()) out[states()] = point.angle;
  for (std::size_t i = 0; i < 2; ++i) {
    out[unknowns() - 2 + static_cast<Index>(i)] = point.place[i] / scale_.ranges[i];
  }
  return out;
}

PlanePlace BorderEquations::place_of(const VectorXd& unknowns) const {
  const Index n = this->unknowns();
  return {unknowns[n - 2] * scale_.ranges[0], unknowns[n - 1] * scale_.ranges[1]};
}

double BorderEquations::angle_of(const VectorXd& unknowns) const {
  if (has_angle()) return unknowns[states()];
  return kind_ == BorderKind::fold ? 0.0 : std::numbers::pi;
}

OrbitQuery BorderEquations::query_at(const VectorXd& unknowns) const {
  const PlanePlace place = place_of(unknowns);
  return {{place.begin(), place.end()}, scale_.sizes.cwiseProduct(unknowns.head(states())), period_};
}

MatrixXd BorderEquations::scaled(const MatrixXd& derivative) const {
  return scale_.sizes.cwiseInverse().asDiagonal() * derivative * scale_.sizes.asDiagonal();
}

VectorXd BorderEquations::return_of(const OrbitAnswer& answer, const VectorXd& unknowns) const {
  VectorXd out = answer.image - scale_.sizes.cwiseProduct(unknowns.head(states()));
  for (const std::size_t angle : plane_.model->angles) {
    double& turn = out[static_cast<Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return out.cwiseQuotient(scale_.sizes);
}

std::optional<NullVectors> BorderEquations::null_vectors_near(const VectorXd& guess) const {
  const std::optional<OrbitAnswer> answer = map_->answer({query_at(guess)}).front();
  if (!answer) return std::nullopt;
  const MatrixXcd matrix = less_multiplier(scaled(answer->derivative), angle_of(guess));
  const Eigen::JacobiSVD<MatrixXcd> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index last = states() - 1;
  return NullVectors{svd.matrixU().col(last), svd.matrixV().col(last)};
}

std::optional<BorderEquations::Linearized> BorderEquations::at(const VectorXd& unknowns,
                                                               const NullVectors& near) const {
  const Index n = states(), all = this->unknowns();
  std::vector<OrbitQuery> queries = {query_at(unknowns)};
  std::vector<VectorXd> ways;
  const auto ask = [&](const VectorXd& way) {
    ways.push_back(way);
    queries.push_back(query_at(unknowns + kDifference * way));
  };
  for (Index i = 1; i <= 2; ++i) ask(VectorXd::Unit(all, all - i));
  VectorXd way = VectorXd::Zero(all);
  way.head(n) = near.right.real();
  ask(way);
  if (has_angle()) {
    way.head(n) = near.right.imag();
    ask(way);
  }
  const std::vector<std::optional<OrbitAnswer>> answers = map_->answer(queries);
  if (std::ranges::any_of(answers, [](const auto& answer) { return !answer; })) return std::nullopt;

  Linearized out;
  out.monodromy = scaled(answers[0]->derivative);
  const auto change = [&](std::size_t query) -> MatrixXd {
    return (scaled(answers[query]->derivative) - out.monodromy) / kDifference;
  };
  const double angle = angle_of(unknowns);
  const Bordered bordered = solve_bordered(less_multiplier(out.monodromy, angle), near);
  out.null_vectors = {bordered.left.normalized(), bordered.right.normalized()};

  const Index equations = n + (has_angle() ? 2 : 1);
  out.residual.resize(equations);
  out.slope.setZero(equations, all);
  const auto set_value = [&](Index column, std::complex<double> slope) {
    out.slope(n, column) = slope.real();
    if (has_angle()) out.slope(n + 1, column) = slope.imag();
  };
  out.residual.head(n) = return_of(*answers[0], unknowns);
  out.residual[n] = bordered.value.real();
  if (has_angle()) out.residual[n + 1] = bordered.value.imag();
  out.slope.topLeftCorner(n, n) = out.monodromy - MatrixXd::Identity(n, n);
  for (Index i = 1; i <= 2; ++i) {
    const auto query = static_cast<std::size_t>(i);
    out.slope.col(all - i).head(n) =
        (return_of(*answers[query], unknowns) - out.residual.head(n)) / kDifference;
    set_value(all - i, -bordered.left.dot(change(query) * bordered.right));
  }
  // The second derivative is symmetric: its change along the null vector is the change of its
  // product with the null vector along each state.
  MatrixXcd bend = change(3).cast<std::complex<double>>();
  if (has_angle()) bend += std::complex<double>(0.0, 1.0) * change(4);
  bend *= bordered.right.norm();
  const Eigen::RowVectorXcd by_state = -bordered.left.adjoint() * bend;
  for (Index i = 0; i < n; ++i) set_value(i, by_state[i]);
  if (has_angle()) {
    const std::complex<double> turned(0.0, 1.0);
    set_value(n, bordered.left.dot(bordered.right) * turned * std::polar(1.0, angle));
  }
  const VectorXd left = out.null_vectors.left.real(), right = out.null_vectors.right.real();
  out.overlap = left.dot(right);
  out.fold_bend = left.dot(bend.real() / bordered.right.norm() * right);
  return out;
}

std::optional<BorderPoint> BorderEquations::correct(const VectorXd& guess, const VectorXd& across,
                                                    const NullVectors& near, double reach) const {
  const Index all = unknowns();
  VectorXd z = guess;
  NullVectors vectors = near;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= kMaxIterations; ++iteration) {
    if (!z.allFinite() || (z - guess).norm() > reach || !plane_.is_allowed(place_of(z))) {
      return std::nullopt;
    }
    const std::optional<Linearized> now = at(z, vectors);
    if (!now || !now->slope.allFinite()) return std::nullopt;
    VectorXd residual(all);
    residual << now->residual, across.dot(z - guess);
    MatrixXd slope(all, all);
    slope << now->slope, across.transpose();
    const Eigen::FullPivLU<MatrixXd> solver(slope);
    const double off = residual.cwiseAbs().maxCoeff();
    if (off <= kResidual || (off <= kRounding && off > kBetter * before)) {
      BorderPoint point;
      point.place = place_of(z);
      point.state = scale_.sizes.cwiseProduct(z.head(states()));
      point.angle = angle_of(z);
      point.multipliers = now->monodromy.eigenvalues();
      std::ranges::sort(point.multipliers, [](const auto& a, const auto& b) {
        return std::abs(a) > std::abs(b);
      });
      point.residual = off;
      point.fold_bend = now->fold_bend;
      point.overlap = now->overlap;
      point.tangent = solver.solve(VectorXd::Unit(all, all - 1)).normalized();
      point.null_vectors = now->null_vectors;
      point.iterations = iteration;
      return point;
    }
    before = off;
    z -= solver.solve(residual);
    vectors = now->null_vectors;
  }
  return std::nullopt;
}

}  // namespace gearsweep
