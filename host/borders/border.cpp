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

Bordered solve_bordered(const MatrixXcd& matrix, const Critical& near) {
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
    case BorderKind::symmetry_breaking:
      return "symmetry breaking";
    case BorderKind::grazing:
      return "grazing";
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
                                 std::size_t period, BorderScale scale, GrazedLimit limit)
    : plane_(plane),
      map_(map),
      kind_(kind),
      period_(period),
      scale_(std::move(scale)),
      limit_(limit) {}

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
  // The angle of the half return map, where a symmetry breaks.
  return kind_ == BorderKind::fold ? 0.0 : std::numbers::pi;
}

OrbitQuery BorderEquations::query_at(const VectorXd& unknowns, const Critical& near) const {
  const PlanePlace place = place_of(unknowns);
  OrbitQuery query{
      {place.begin(), place.end()}, scale_.sizes.cwiseProduct(unknowns.head(states())), period_};
  query.is_half = kind_ == BorderKind::symmetry_breaking;
  if (grazes()) query.graze = GrazeMark{limit_, near.moment};
  return query;
}

MatrixXd BorderEquations::scaled(const MatrixXd& derivative) const {
  return scale_.sizes.cwiseInverse().asDiagonal() * derivative * scale_.sizes.asDiagonal();
}

VectorXd BorderEquations::return_of(const OrbitAnswer& answer, const VectorXd& unknowns) const {
  return gearsweep::residual_of(plane_, answer, scale_.sizes.cwiseProduct(unknowns.head(states())),
                                scale_.sizes);
}

std::optional<Critical> BorderEquations::critical_near(const VectorXd& guess) const {
  const std::optional<OrbitAnswer> answer = map_->answer({query_at(guess, {})}).front();
  if (!answer) return std::nullopt;
  const MatrixXcd matrix = less_multiplier(scaled(answer->derivative), angle_of(guess));
  const Eigen::JacobiSVD<MatrixXcd> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index last = states() - 1;
  return Critical{svd.matrixU().col(last), svd.matrixV().col(last), 0.0};
}

VectorXd BorderEquations::residual_of(const OrbitAnswer& answer, const VectorXd& unknowns,
                                      const Critical& near, State* state) const {
  const Index n = states();
  if (answer.derivative.cols() > 0) state->monodromy = scaled(answer.derivative);
  state->turn = answer.turn;
  if (grazes()) {
    state->critical.moment = answer.turn->moment;
    VectorXd out(n + 1);
    out << return_of(answer, unknowns), answer.turn->level / scale_.level;
    return out;
  }
  const Bordered bordered =
      solve_bordered(less_multiplier(state->monodromy, angle_of(unknowns)), near);
  state->critical = {bordered.left.normalized(), bordered.right.normalized(), 0.0};
  state->overlap = state->critical.left.real().dot(state->critical.right.real());
  state->stretch = {bordered.left, bordered.right, 0.0};
  VectorXd out(n + (has_angle() ? 2 : 1));
  out.head(n) = return_of(answer, unknowns);
  out[n] = bordered.value.real();
  if (has_angle()) out[n + 1] = bordered.value.imag();
  return out;
}

std::optional<BorderEquations::Linearized> BorderEquations::at(const VectorXd& unknowns,
                                                               const Critical& near) const {
  const Index n = states(), all = this->unknowns();
  std::vector<OrbitQuery> queries = {query_at(unknowns, near)};
  const auto ask = [&](const VectorXd& way) {
    queries.push_back(query_at(unknowns + kDifference * way, near));
    queries.back().needs_derivative = !grazes();
  };
  for (Index i = 1; i <= 2; ++i) ask(VectorXd::Unit(all, all - i));
  VectorXd way = VectorXd::Zero(all);
  if (!grazes()) {
    way.head(n) = near.right.real();
    ask(way);
  }
  if (has_angle()) {
    way.head(n) = near.right.imag();
    ask(way);
  }
  const std::vector<std::optional<OrbitAnswer>> answers = map_->answer(queries);
  if (std::ranges::any_of(answers, [](const auto& answer) { return !answer; })) return std::nullopt;

  Linearized out;
  out.residual = residual_of(*answers[0], unknowns, near, &out.state);
  out.slope.setZero(out.residual.size(), all);
  out.slope.topLeftCorner(n, n) = out.state.monodromy - MatrixXd::Identity(n, n);
  for (Index i = 1; i <= 2; ++i) {
    out.slope.col(all - i).head(n) =
        (return_of(*answers[static_cast<std::size_t>(i)], unknowns) - out.residual.head(n)) /
        kDifference;
  }
  if (grazes()) {
    const LevelTurn& turn = *out.state.turn;
    out.slope.row(n).head(n) = turn.gradient * scale_.sizes.asDiagonal() / scale_.level;
    for (Index i = 1; i <= 2; ++i) {
      out.slope(n, all - i) = (answers[static_cast<std::size_t>(i)]->turn->level - turn.level) /
                              (scale_.level * kDifference);
    }
  } else {
    take_bend(answers, unknowns, &out);
  }
  return out;
}

// What changes the bordered scalar.
void BorderEquations::take_bend(const std::vector<std::optional<OrbitAnswer>>& answers,
                                const VectorXd& unknowns, Linearized* out) const {
  const Index n = states(), all = this->unknowns();
  const Critical& stretch = out->state.stretch;
  const auto change = [&](std::size_t query) -> MatrixXd {
    return (scaled(answers[query]->derivative) - out->state.monodromy) / kDifference;
  };
  const auto set_value = [&](Index column, std::complex<double> slope) {
    out->slope(n, column) = slope.real();
    if (has_angle()) out->slope(n + 1, column) = slope.imag();
  };
  for (Index i = 1; i <= 2; ++i) {
    set_value(all - i, -stretch.left.dot(change(static_cast<std::size_t>(i)) * stretch.right));
  }
  const Critical& unit = out->state.critical;
  if (kind_ == BorderKind::fold) {
    const auto by_parameters = out->slope.topRightCorner(n, 2);
    out->transversality =
        (unit.left.real().transpose() * by_parameters).norm() / by_parameters.norm();
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
  out->fold_bend = unit.left.real().dot(bend.real() / stretch.right.norm() * unit.right.real());
}

OrbitQuery BorderEquations::query_of(const BorderPoint& point) const {
  return query_at(unknowns_of(point), point.critical);
}

VectorXd BorderEquations::residual_of(const BorderPoint& point, const OrbitAnswer& answer) const {
  State state;
  return residual_of(answer, unknowns_of(point), point.critical, &state);
}

std::optional<MatrixXd> BorderEquations::slope_at(const BorderPoint& point) const {
  std::optional<Linearized> out = at(unknowns_of(point), point.critical);
  if (!out) return std::nullopt;
  return std::move(out->slope);
}

std::optional<BorderPoint> BorderEquations::correct(const VectorXd& guess, const VectorXd& across,
                                                    const Critical& near, double reach) const {
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
      if (grazes() && iteration > 0) {  // its multipliers, which no residual needs
        const std::optional<OrbitAnswer> answer = map_->answer({query_at(z, near)}).front();
        if (!answer) return std::nullopt;
        residual_of(*answer, z, near, &now);
      }
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
    OrbitQuery query = query_at(z, near);
    query.needs_derivative = !grazes();
    const std::optional<OrbitAnswer> answer = map_->answer({query}).front();
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
  point.multipliers = state.monodromy.eigenvalues();
  switch (kind_) {
    case BorderKind::symmetry_breaking:  // the return map is the half one, twice
      point.multipliers = point.multipliers.cwiseProduct(point.multipliers).eval();
      break;
    case BorderKind::grazing:
      break;
    default:
      point.angle = angle_of(unknowns);
  }
  std::ranges::sort(point.multipliers,
                    [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  point.overlap = state.overlap;
  point.critical = state.critical;
  return point;
}

}  // namespace gearsweep
