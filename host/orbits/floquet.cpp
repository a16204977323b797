#include "orbits/floquet.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/eigenvalues.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kResidual = 1e-12;  // of the state's size, per norm of the monodromy matrix
constexpr int kMaxIterations = 40;
constexpr int kMaxHalvings = 10;     // of a Newton step
constexpr double kSameOrbit = 1e-8;  // of the state's size: two states of one orbit

double size_of(const VectorXd& v) { return v.cwiseAbs().maxCoeff(); }

// Rounding of the end state is that of the start, as far as the flow stretches it.
double reachable_residual(const VectorXd& state, const MatrixXd& monodromy) {
  return kResidual * scale_of(state) * std::max(1.0, 1e-2 * monodromy.cwiseAbs().maxCoeff());
}

// The smallest divisor of the orbit's period after which the state is back.
std::size_t min_period(const PeriodMap& map, const Orbit& orbit) {
  VectorXd state = orbit.state;
  for (std::size_t divisor = 1; divisor < orbit.period; ++divisor) {
    const std::optional<VectorXd> next = map.advance(state, 1);
    if (!next) break;
    state = *next;
    if (orbit.period % divisor == 0 &&
        size_of(state - orbit.state) < kSameOrbit * scale_of(orbit.state)) {
      return divisor;
    }
  }
  return orbit.period;
}

// The states at phase 0 of a trajectory, its start first.
std::vector<VectorXd> section(const PeriodMap& map, const VectorXd& start, std::size_t periods) {
  std::vector<VectorXd> states = {start};
  while (states.size() <= periods) {
    const std::optional<VectorXd> next = map.advance(states.back(), 1);
    if (!next) throw RunError("the trajectory left the finite range while an orbit was looked for");
    states.push_back(*next);
  }
  return states;
}

// The smallest period after which the last state of a trajectory repeats an earlier one. Close
// returns come first: a coarse tolerance would take an orbit that has just doubled for the one
// before. 0 when there is none.
std::size_t return_period(const std::vector<VectorXd>& states) {
  const VectorXd& last = states.back();
  for (int digits = 9; digits >= 3; --digits) {
    const double tolerance = std::pow(10.0, -digits);
    for (std::size_t period = 1; period < states.size(); ++period) {
      const VectorXd& earlier = states[states.size() - 1 - period];
      if (size_of(last - earlier) < tolerance * scale_of(last)) return period;
    }
  }
  return 0;
}

// The state of a trajectory that the `period`-th iterate moves least.
VectorXd closest_return(const std::vector<VectorXd>& states, std::size_t period) {
  double min = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t i = 0; i + period < states.size(); ++i) {
    const double moved = size_of(states[i + period] - states[i]);
    if (moved < min) {
      min = moved;
      best = i;
    }
  }
  return states[best];
}

}  // namespace

std::string name_of(Bifurcation kind) {
  switch (kind) {
    case Bifurcation::fold:
      return "fold";
    case Bifurcation::branching:
      return "symmetry breaking";
    case Bifurcation::flip:
      return "flip";
    case Bifurcation::neimark_sacker:
      return "Neimark-Sacker";
  }
  return "";
}

bool Orbit::stable() const { return unstable_count() == 0; }

std::size_t Orbit::unstable_count() const {
  return static_cast<std::size_t>((multipliers.cwiseAbs().array() > 1.0).count());
}

Nearest nearest_bifurcation(const Orbit& orbit) {
  const auto distance = [](const std::complex<double>& m) { return std::fabs(1.0 - std::abs(m)); };
  const std::complex<double> nearest =
      *std::min_element(orbit.multipliers.begin(), orbit.multipliers.end(),
                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  Nearest out;
  out.multiplier = nearest;
  out.margin = 1.0 - std::abs(nearest);
  if (nearest.imag() != 0.0) {
    out.kind = Bifurcation::neimark_sacker;
  } else {
    out.kind = nearest.real() > 0.0 ? Bifurcation::fold : Bifurcation::flip;
  }
  return out;
}

std::string name_of(const Nearest& nearest) {
  if (nearest.kind != Bifurcation::fold) return name_of(nearest.kind);
  return "fold or symmetry breaking";
}

Orbit make_orbit(const VectorXd& state, const PeriodImage& image, std::size_t period) {
  const std::vector<std::complex<double>> multipliers =
      eigenvalues(image.monodromy.data(), static_cast<std::size_t>(image.monodromy.rows()));
  if (multipliers.empty()) throw RunError("the multipliers of an orbit cannot be computed");
  Orbit orbit{state, period, image.monodromy,
              Eigen::Map<const Eigen::VectorXcd>(multipliers.data(),
                                                 static_cast<Eigen::Index>(multipliers.size())),
              image.graze};
  // Of a complex pair, which has one modulus, the member above the real axis comes first.
  std::stable_sort(orbit.multipliers.begin(), orbit.multipliers.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return orbit;
}

double scale_of(const VectorXd& state) { return std::max(1.0, size_of(state)); }

std::optional<Orbit> shoot(const PeriodMap& map, const VectorXd& guess, std::size_t period) {
  const MatrixXd identity = MatrixXd::Identity(guess.size(), guess.size());
  VectorXd state = guess;
  std::optional<PeriodImage> image = map.linearize(state, period);
  for (int iteration = 0; image && iteration < kMaxIterations; ++iteration) {
    const VectorXd residual = image->state - state;
    const double before = size_of(residual);
    if (before <= reachable_residual(state, image->monodromy)) {
      return make_orbit(state, *image, period);
    }
    const VectorXd step = (image->monodromy - identity).fullPivLu().solve(-residual);
    std::optional<PeriodImage> next;
    double damping = 1.0;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, damping *= 0.5) {
      next = map.linearize(state + damping * step, period);
      if (next && size_of(next->state - (state + damping * step)) < before) break;
      next.reset();
    }
    state += damping * step;
    image = std::move(next);
  }
  return std::nullopt;
}

Orbit find_orbit(const PeriodMap& map, const VectorXd& settled, std::optional<std::size_t> period) {
  const std::vector<VectorXd> states =
      section(map, settled, kLongestPeriod + 4 * period.value_or(0));
  const std::size_t wanted = period ? *period : return_period(states);
  if (wanted == 0) {
    throw RunError(
        fmt::format("the trajectory does not repeat itself within {} periods: it is chaotic, or "
                    "not settled (raise integrate.settle). An unstable orbit inside chaos can be "
                    "found with --period",
                    kLongestPeriod));
  }
  const VectorXd guess = period ? closest_return(states, wanted) : states.back();
  const std::optional<Orbit> found = shoot(map, guess, wanted);
  if (!found) {
    throw RunError(
        fmt::format("Newton's method found no orbit of period {}: try a longer integrate.settle, "
                    "another --period, or more --steps",
                    wanted));
  }
  const std::size_t min = min_period(map, *found);
  if (min == wanted) return *found;
  if (period) {
    throw RunError(fmt::format(
        "Newton's method came to an orbit of period {}, not {}: give --period {}, or another "
        "start (a state in --at)",
        min, wanted, min));
  }
  const std::optional<PeriodImage> image = map.linearize(found->state, min);
  return make_orbit(found->state, *image, min);
}

}  // namespace gearsweep
