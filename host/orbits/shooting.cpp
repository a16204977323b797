#include "orbits/shooting.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "model/eigenvalues.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kResidual = 1e-12;  // of the states' sizes
constexpr int kMaxIterations = 40;
constexpr int kMaxHalvings = 10;          // of a Newton step
constexpr double kLongerOrShorter = 4.0;  // a cycle than what it is looked for by
constexpr double kMade = 1e-3;            // of what sizes of others become in a state
constexpr double kBalanced = 1e-9;        // of what the terms of a rate may be
constexpr double kStill = 1e-6;  // of the sizes at the guess: a cycle that moves less is none

// What sizes of states make of each other in the time of the fastest rate: a velocity that is 0 at
// a guess, or rounding, is not of no size.
VectorXd made_of(const VectorXd& sizes, const MatrixXd& jacobian) {
  if (!jacobian.allFinite()) return sizes;
  double fastest = 0.0;
  for (const std::complex<double>& value :
       eigenvalues(jacobian.data(), static_cast<std::size_t>(jacobian.rows()))) {
    fastest = std::max(fastest, std::abs(value));
  }
  VectorXd made = sizes;
  for (Index i = 0; i < sizes.size() && fastest > 0.0; ++i) {
    made = made.cwiseMax(kMade * jacobian.cwiseAbs() * made / fastest);
  }
  return made;
}

// Newton's method from unknowns; sizes: those of the guess, which distances are judged in.
std::optional<Orbit> solve(const PeriodMap& map, const Shooting& shooting, VectorXd z) {
  const PhasePlane plane = shooting.plane_at(map, z);
  std::optional<Shooting::Equations> now = shooting.at(map, z, plane);
  for (int iteration = 0; now && iteration < kMaxIterations; ++iteration) {
    if ((now->residual.cwiseAbs().array() <= kResidual * now->rounding.array()).all()) {
      return shooting.orbit_at(map, z, now->image);
    }
    const double before = now->residual.cwiseAbs().maxCoeff();
    const VectorXd step = now->slope.fullPivLu().solve(-now->residual);
    std::optional<Shooting::Equations> next;
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
                        image.maxima[returning_state(map.model())]);
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
  if (!found || distance_of(found->sizes, shooting.sizes()) < kStill) return std::nullopt;
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
  return find_equilibrium(map, guess, guess);
}

std::optional<Orbit> find_equilibrium(const PeriodMap& map, const VectorXd& guess,
                                      const VectorXd& way) {
  VectorXd state = guess;
  // The largest that each state, or a step of it, has had; and some of what others make of it.
  VectorXd sizes = guess.cwiseAbs().cwiseMax(way.cwiseAbs());
  sizes = sizes.cwiseMax(made_of(sizes, map.rate_slope(guess)));
  const auto judged = [&](const VectorXd& change) {
    return change
        .binaryExpr(sizes, [](double one, double size) { return size > 0.0 ? one / size : 0.0; })
        .cwiseAbs()
        .maxCoeff();
  };
  // In sizes of states: in their own units a pivot may count as 0.
  const auto solver_at = [&](const VectorXd& x, const VectorXd& scale) {
    return Eigen::FullPivLU<MatrixXd>(scale.cwiseInverse().asDiagonal() * map.rate_slope(x) *
                                      scale.asDiagonal());
  };
  const auto scale_of = [](const VectorXd& of) {
    return VectorXd(of.unaryExpr([](double size) { return size > 0.0 ? size : 1.0; }));
  };
  const auto step_from = [&](const VectorXd& x) -> VectorXd {
    const VectorXd scale = scale_of(sizes);
    return scale.cwiseProduct(solver_at(x, scale).solve(-map.rate(x).cwiseQuotient(scale)));
  };
  VectorXd step = step_from(state);
  for (int iteration = 0; iteration < kMaxIterations && step.allFinite(); ++iteration) {
    sizes = sizes.cwiseMax(step.cwiseAbs()).cwiseMax(state.cwiseAbs());
    if (judged(step) <= kResidual) {
      state = (state.array().abs() <= kResidual * sizes.array()).select(0.0, state);
      const MatrixXd slope = map.rate_slope(state);
      // A field that no state changes is solved by no step at all.
      const VectorXd allowed = kBalanced * (slope.cwiseAbs() * sizes);
      if ((map.rate(state).cwiseAbs().array() > allowed.array()).any()) return std::nullopt;
      // What is 0 in all that was met has no size of its own.
      return make_equilibrium(state, slope,
                              sizes.unaryExpr([](double size) { return size > 0.0 ? size : 1.0; }));
    }
    // The step that the next one would be, judged by the same Jacobian (P. Deuflhard's natural
    // monotonicity test), must be smaller.
    const VectorXd scale = scale_of(sizes);
    const Eigen::FullPivLU<MatrixXd> solver = solver_at(state, scale);
    double damping = 1.0;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, damping *= 0.5) {
      const VectorXd rate = map.rate(state + damping * step);
      const VectorXd again = scale.cwiseProduct(solver.solve(-rate.cwiseQuotient(scale)));
      if (again.allFinite() && judged(again) < judged(step)) break;
    }
    state += damping * step;
    step = step_from(state);
  }
  return std::nullopt;
}

}  // namespace gearsweep
