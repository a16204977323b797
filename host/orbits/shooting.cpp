#include "orbits/shooting.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kResidual = 1e-12;  // of the states' sizes
constexpr double kOffset = 0.1;      // of the largest offset: how much of it all states get
constexpr double kBetter = 0.5;      // of a residual that may be rounding: one that is not
constexpr int kMaxIterations = 40;
// An equilibrium may take many: a start may lie on the other side of a place where the Jacobian is
// singular, which the method leaves by chance.
constexpr int kMaxRestIterations = 400;
constexpr int kMaxHalvings = 10;          // of a Newton step
constexpr double kLongerOrShorter = 4.0;  // a cycle than what it is looked for by
constexpr double kBalanced = 1e-9;        // of what the terms of a rate may be
constexpr double kEightRoundings = 1.8e-15;
constexpr double kStill = 1e-6;  // of the sizes at the guess: a cycle that moves less is none

// Newton's method from unknowns; sizes: those of the guess, which distances are judged in. Where a
// state is counted from far off, what is left of a residual may be rounding: it is, if a step makes
// it no better.
std::optional<Orbit> solve(const PeriodMap& map, const Shooting& shooting, VectorXd z) {
  const PhasePlane plane = shooting.plane_at(map, z);
  std::optional<Shooting::Equations> now = shooting.at(map, z, plane);
  for (int iteration = 0; now && iteration < kMaxIterations; ++iteration) {
    const auto is_within = [&](const VectorXd& rounding) {
      return (now->residual.cwiseAbs().array() <= kResidual * rounding.array()).all();
    };
    if (is_within(now->rounding)) return shooting.orbit_at(map, z, now->image);
    const double before = now->residual.cwiseAbs().maxCoeff();
    const VectorXd step = now->slope.fullPivLu().solve(-now->residual);
    std::optional<Shooting::Equations> next;
    const double offset = kOffset * offset_of(now->image.extent, shooting.sizes());
    if (is_within(now->rounding.cwiseMax(offset))) {
      next = shooting.at(map, z + step, plane);
      if (!next || !(next->residual.cwiseAbs().maxCoeff() < kBetter * before)) {
        return shooting.orbit_at(map, z, now->image);
      }
      z += step;
      now = std::move(next);
      continue;
    }
    double damping = 1.0;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, damping *= 0.5) {
      next = shooting.at(map, z + damping * step, plane);
      if (next && next->residual.cwiseAbs().maxCoeff() < before) break;
      next.reset();
    }
    z += damping * step;
    now = std::move(next);
  }
  return std::nullopt;
}

// The equilibrium at a state that Newton's method does not leave. Nothing where the field is not 0
// there: one that no state changes is solved by no step at all.
std::optional<Orbit> balanced(const VectorXd& state, const PeriodMap& map, const VectorXd& sizes) {
  const MatrixXd jacobian = map.rate_slope(state);
  const VectorXd allowed = kBalanced * (jacobian.cwiseAbs() * sizes);
  if ((map.rate(state).cwiseAbs().array() > allowed.array()).any()) return std::nullopt;
  return make_equilibrium(state, jacobian, above_zero(sizes.cwiseMax(state.cwiseAbs())));
}

}  // namespace

OrbitForm form_of(const Orbit& orbit) {
  OrbitForm form = {orbit.kind, orbit.period, orbit.steps, orbit.duration};
  if (orbit.kind == OrbitKind::equilibrium) {
    const double fastest = orbit.multipliers.cwiseAbs().maxCoeff();
    form.time = fastest > 0.0 ? 1.0 / fastest : 1.0;
  }
  return form;
}

Shooting::Shooting(const OrbitForm& form, VectorXd sizes) : form_(form), sizes_(std::move(sizes)) {}

VectorXd Shooting::unknowns_of(const Orbit& orbit) const {
  VectorXd z(unknowns());
  z.head(states()) = orbit.state.cwiseQuotient(sizes_);
  if (has_length()) z[states()] = orbit.duration / form_.time;
  return z;
}

VectorXd Shooting::state_of(const VectorXd& unknowns) const {
  return sizes_.cwiseProduct(unknowns.head(states()));
}

double Shooting::duration_of(const VectorXd& unknowns) const {
  return has_length() ? form_.time * unknowns[states()] : 0.0;
}

PhasePlane Shooting::plane_at(const PeriodMap& map, const VectorXd& unknowns) const {
  if (!has_length()) return {};
  const VectorXd rate = map.rate(state_of(unknowns)).cwiseQuotient(sizes_);
  return {unknowns.head(states()), rate.normalized()};
}

std::optional<PeriodImage> Shooting::linearize(const PeriodMap& map,
                                               const VectorXd& unknowns) const {
  const VectorXd state = state_of(unknowns);
  switch (form_.kind) {
    case OrbitKind::forced:
      return map.linearize(state, form_.period);
    case OrbitKind::cycle: {
      const double length = unknowns[states()];
      if (!(length > 1.0 / kLongerOrShorter && length < kLongerOrShorter)) return std::nullopt;
      return map.linearize(state, TimeSpan{duration_of(unknowns), form_.steps});
    }
    case OrbitKind::equilibrium:
      break;
  }
  PeriodImage image;
  image.state = state + form_.time * map.rate(state);
  image.monodromy = MatrixXd::Identity(states(), states()) + form_.time * map.rate_slope(state);
  image.extent = {state, state};
  if (!image.state.allFinite() || !image.monodromy.allFinite()) return std::nullopt;
  return image;
}

std::optional<Shooting::Equations> Shooting::at(const PeriodMap& map, const VectorXd& unknowns,
                                                const PhasePlane& plane) const {
  std::optional<PeriodImage> image = linearize(map, unknowns);
  if (!image) return std::nullopt;
  const Index n = states();
  const VectorXd state = state_of(unknowns);
  Equations out;
  out.residual.resize(this->unknowns());
  out.rounding.resize(this->unknowns());
  out.slope.setZero(this->unknowns(), this->unknowns());
  out.residual.head(n) = map.difference(image->state, state).cwiseQuotient(sizes_);
  out.rounding.head(n) = rounding_sizes(*image, sizes_).cwiseQuotient(sizes_);
  out.slope.topLeftCorner(n, n) =
      sizes_.cwiseInverse().asDiagonal() * image->monodromy * sizes_.asDiagonal();
  out.slope.topLeftCorner(n, n).diagonal().array() -= 1.0;
  if (has_length()) {
    out.slope.col(n).head(n) = form_.time * map.rate(image->state).cwiseQuotient(sizes_);
    out.slope.row(n).head(n) = plane.direction.transpose();
    out.residual[n] = plane.direction.dot(unknowns.head(n) - plane.place);
    out.rounding[n] = plane.direction.cwiseAbs().dot(out.rounding.head(n));
  }
  out.image = *std::move(image);
  return out;
}

std::optional<VectorXd> Shooting::image(const PeriodMap& map, const VectorXd& unknowns) const {
  const VectorXd state = state_of(unknowns);
  std::optional<VectorXd> end;
  switch (form_.kind) {
    case OrbitKind::forced:
      end = map.advance(state, form_.period);
      break;
    case OrbitKind::cycle:
      end = map.advance(state, TimeSpan{duration_of(unknowns), form_.steps});
      break;
    case OrbitKind::equilibrium:
      end = state + form_.time * map.rate(state);
      break;
  }
  if (!end) return std::nullopt;
  return end->cwiseQuotient(sizes_);
}

Orbit Shooting::orbit_at(const PeriodMap& map, const VectorXd& unknowns,
                         const PeriodImage& image) const {
  const VectorXd state = state_of(unknowns);
  switch (form_.kind) {
    case OrbitKind::forced:
      return make_orbit(state, image, form_.period);
    case OrbitKind::cycle:
      return make_cycle(state, image, {duration_of(unknowns), form_.steps}, map.rate(state),
                        image.returns);
    case OrbitKind::equilibrium:
      break;
  }
  return make_equilibrium(state, map.rate_slope(state), sizes_);
}

std::optional<Orbit> shoot(const PeriodMap& map, const VectorXd& guess, std::size_t period) {
  const std::optional<PeriodImage> image = map.linearize(guess, period);
  if (!image) return std::nullopt;
  const Shooting shooting({.kind = OrbitKind::forced, .period = period}, sizes_of(*image));
  return solve(map, shooting, guess.cwiseQuotient(shooting.sizes()));
}

std::optional<Orbit> shoot_cycle(const PeriodMap& map, const VectorXd& guess,
                                 const TimeSpan& span) {
  const std::optional<PeriodImage> image = map.linearize(guess, span);
  if (!image) return std::nullopt;
  const Shooting shooting({.kind = OrbitKind::cycle, .steps = span.steps, .time = span.duration},
                          sizes_of(*image));
  VectorXd z(guess.size() + 1);
  z << guess.cwiseQuotient(shooting.sizes()), 1.0;
  std::optional<Orbit> found = solve(map, shooting, z);
  // Any length brings a state of rest back.
  if (!found || distance_of(found->extent.swing(), shooting.sizes()) < kStill) return std::nullopt;
  return found;
}

std::optional<Orbit> shoot_again(const PeriodMap& map, const Orbit& near, std::size_t steps) {
  switch (near.kind) {
    case OrbitKind::forced:
      return shoot(map, near.state, near.period);
    case OrbitKind::cycle:
      return shoot_cycle(map, near.state, {near.duration, steps});
    case OrbitKind::equilibrium:
      break;
  }
  return find_equilibrium(map, near.state);
}

std::optional<Orbit> find_equilibrium(const PeriodMap& map, const VectorXd& guess) {
  return find_equilibrium(map, guess, VectorXd::Zero(guess.size()));
}

std::optional<Orbit> find_equilibrium(const PeriodMap& map, const VectorXd& guess,
                                      const VectorXd& way) {
  VectorXd state = guess;
  // The largest way that each state has come, or a step of it, wherever it is counted from; and
  // some of what others make of it.
  VectorXd sizes = spread_of((kMinSize * guess.cwiseAbs()).cwiseMax(way.cwiseAbs()),
                             map.rate_slope(guess), kMadeOfOthers);
  for (int iteration = 0; iteration < kMaxRestIterations; ++iteration) {
    // In sizes of states: in their own units a pivot may count as 0.
    const VectorXd scale = above_zero(sizes.cwiseMax(state.cwiseAbs()));
    const MatrixXd jacobian = map.rate_slope(state);
    const Eigen::FullPivLU<MatrixXd> solver(scale.cwiseInverse().asDiagonal() * jacobian *
                                            scale.asDiagonal());
    const auto step_by = [&](const VectorXd& rate) -> VectorXd {
      return scale.cwiseProduct(solver.solve(-rate.cwiseQuotient(scale)));
    };
    const VectorXd step = step_by(map.rate(state));
    if (!step.allFinite()) return std::nullopt;
    sizes = sizes.cwiseMax(step.cwiseAbs()).cwiseMax(kMinSize * state.cwiseAbs());
    const VectorXd judged_in = above_zero(sizes);
    // What rounding of the states makes of their rates, and so of the step.
    const VectorXd rounding = kEightRoundings * (scale.asDiagonal() * solver.inverse().cwiseAbs() *
                                                 scale.cwiseInverse().asDiagonal() *
                                                 (jacobian.cwiseAbs() * state.cwiseAbs()));
    const bool is_rounding =
        rounding.allFinite() &&
        (step.cwiseAbs().array() <= (kResidual * judged_in).cwiseMax(rounding).array()).all();
    if (is_rounding || distance_of(step, judged_in) <= kResidual) {
      return balanced((state.array().abs() <= kResidual * sizes.array()).select(0.0, state), map,
                      sizes);
    }
    // The step that the next one would be, judged by the same Jacobian (P. Deuflhard's natural
    // monotonicity test), must be smaller.
    double damping = 1.0;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, damping *= 0.5) {
      const VectorXd again = step_by(map.rate(state + damping * step));
      if (again.allFinite() && distance_of(again, judged_in) < distance_of(step, judged_in)) break;
    }
    state += damping * step;
  }
  return std::nullopt;
}

}  // namespace gearsweep
