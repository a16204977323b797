#include "borders/border.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "borders/held_orbits.hpp"

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
constexpr double kOnCircle = 1e-6;  // a modulus that differs from 1 by no more
constexpr double kBetter = 0.5;
constexpr double kWorse = 2.0;  // than the residual before: it does not converge
constexpr int kMaxIterations = 10;

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

bool BorderPoint::is_of_stable_motion() const {
  return std::ranges::none_of(multipliers,
                              [](const auto& m) { return std::abs(m) > 1.0 + kOnCircle; });
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
  return {
      {place.begin(), place.end()}, scale_.sizes.cwiseProduct(unknowns.head(states())), period_};
}

MatrixXd BorderEquations::scaled(const MatrixXd& derivative) const {
  return scale_.sizes.cwiseInverse().asDiagonal() * derivative * scale_.sizes.asDiagonal();
}

VectorXd BorderEquations::return_of(const OrbitAnswer& answer, const VectorXd& unknowns) const {
  return gearsweep::residual_of(plane_, answer, query_at(unknowns).state, scale_.sizes);
}

std::optional<NullVectors> BorderEquations::null_vectors_near(const VectorXd& guess) const {
  const std::optional<OrbitAnswer> answer = map_->answer({query_at(guess)}).front();
  if (!answer) return std::nullopt;
  const MatrixXcd matrix = less_multiplier(scaled(answer->derivative), angle_of(guess));
  const Eigen::JacobiSVD<MatrixXcd> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index last = states() - 1;
  return NullVectors{svd.matrixU().col(last), svd.matrixV().col(last)};
}

VectorXd BorderEquations::residual_of(const OrbitAnswer& answer, const VectorXd& unknowns,
                                      const NullVectors& near, State* state) const {
  const Index n = states();
  state->monodromy = scaled(answer.derivative);
  const Bordered bordered =
      solve_bordered(less_multiplier(state->monodromy, angle_of(unknowns)), near);
  state->null_vectors = {bordered.left.normalized(), bordered.right.normalized()};
  state->overlap = state->null_vectors.left.real().dot(state->null_vectors.right.real());
  state->stretch = {bordered.left, bordered.right};
  VectorXd out(n + (has_angle() ? 2 : 1));
  out.head(n) = return_of(answer, unknowns);
  out[n] = bordered.value.real();
  if (has_angle()) out[n + 1] = bordered.value.imag();
  return out;
}

std::optional<BorderEquations::Linearized> BorderEquations::at(const VectorXd& unknowns,
                                                               const NullVectors& near) const {
  const Index n = states(), all = this->unknowns();
  std::vector<OrbitQuery> queries = {query_at(unknowns)};
  const auto ask = [&](const VectorXd& way) {
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
  out.residual = residual_of(*answers[0], unknowns, near, &out.state);
  const NullVectors& stretch = out.state.stretch;
  const auto change = [&](std::size_t query) -> MatrixXd {
    return (scaled(answers[query]->derivative) - out.state.monodromy) / kDifference;
  };
  out.slope.setZero(out.residual.size(), all);
  const auto set_value = [&](Index column, std::complex<double> slope) {
    out.slope(n, column) = slope.real();
    if (has_angle()) out.slope(n + 1, column) = slope.imag();
  };
  out.slope.topLeftCorner(n, n) = out.state.monodromy - MatrixXd::Identity(n, n);
  for (Index i = 1; i <= 2; ++i) {
    const auto query = static_cast<std::size_t>(i);
    out.slope.col(all - i).head(n) =
        (return_of(*answers[query], unknowns) - out.residual.head(n)) / kDifference;
    set_value(all - i, -stretch.left.dot(change(query) * stretch.right));
  }
  const auto by_parameters = out.slope.topRightCorner(n, 2);
  if (kind_ == BorderKind::fold) {
    out.transversality = (out.state.null_vectors.left.real().transpose() * by_parameters).norm() /
                         by_parameters.norm();
  }
  // The second derivative is symmetric: its change along the null vector is the change of its
  // product with the null vector along each state.
  MatrixXcd bend = change(3).cast<std::complex<double>>();
  if (has_angle()) bend += std::complex<double>(0.0, 1.0) * change(4);
  bend *= stretch.right.norm();
  const Eigen::RowVectorXcd by_state = -stretch.left.adjoint() * bend;
  for (Index i = 0; i < n; ++i) set_value(i, by_state[i]);
  if (has_angle()) {
    const std::complex<double> turned(0.0, 1.0);
    set_value(n, stretch.left.dot(stretch.right) * turned * std::polar(1.0, angle_of(unknowns)));
  }
  const NullVectors& unit = out.state.null_vectors;
  out.fold_bend = unit.left.real().dot(bend.real() / stretch.right.norm() * unit.right.real());
  return out;
}

std::optional<BorderPoint> BorderEquations::correct(const VectorXd& guess, const VectorXd& across,
                                                    const NullVectors& near, double reach) const {
  const Index all = unknowns();
  if (!plane_.is_allowed(place_of(guess))) return std::nullopt;
  std::optional<Linearized> first = at(guess, near);
  if (!first || !first->slope.allFinite()) return std::nullopt;
  // One derivative, which Broyden's updates keep up with the residuals: these take a fraction of
  // what derivatives do.
  MatrixXd slope(all, all);
  slope << first->slope, across.transpose();
  const VectorXd tangent = Eigen::FullPivLU<MatrixXd>(slope).solve(VectorXd::Unit(all, all - 1));
  VectorXd z = guess, residual = VectorXd::Zero(all);
  residual.head(all - 1) = first->residual;
  State now = first->state;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= kMaxIterations; ++iteration) {
    const double off = residual.cwiseAbs().maxCoeff();
    if (off <= kResidual || (off <= kRounding && off > kBetter * before)) {
      BorderPoint point = point_at(z, now);
      point.residual = off;
      point.fold_bend = first->fold_bend;
      point.transversality = first->transversality;
      point.tangent = tangent.normalized();
      point.iterations = iteration;
      return point;
    }
    if (!(off < kWorse * before)) return std::nullopt;
    before = off;
    const VectorXd step = Eigen::FullPivLU<MatrixXd>(slope).solve(-residual);
    z += step;
    if (!z.allFinite() || (z - guess).norm() > reach || !plane_.is_allowed(place_of(z))) {
      return std::nullopt;
    }
    const std::optional<OrbitAnswer> answer = map_->answer({query_at(z)}).front();
    if (!answer) return std::nullopt;
    VectorXd next(all);
    next << residual_of(*answer, z, near, &now), across.dot(z - guess);
    slope += (next - residual - slope * step) * step.transpose() / step.squaredNorm();
    residual = next;
  }
  return std::nullopt;
}

BorderPoint BorderEquations::point_at(const VectorXd& unknowns, const State& state) const {
  BorderPoint point;
  point.place = place_of(unknowns);
  point.state = scale_.sizes.cwiseProduct(unknowns.head(states()));
  point.angle = angle_of(unknowns);
  point.multipliers = state.monodromy.eigenvalues();
  std::ranges::sort(point.multipliers,
                    [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  point.overlap = state.overlap;
  point.null_vectors = state.null_vectors;
  return point;
}

}  // namespace gearsweep
