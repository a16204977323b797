#include "orbits/floquet.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/eigenvalues.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kResidual = 1e-12;  // of the states' sizes
constexpr double kCarried = 1e-2;    // of what a period makes of magnitudes: the same for residuals
constexpr double kMinSize = 1e-6;    // of a state's magnitude, and of what is carried into it
constexpr int kMaxIterations = 40;
constexpr int kMaxHalvings = 10;     // of a Newton step
constexpr std::size_t kGuesses = 8;  // of an orbit inside chaos
constexpr double kSameOrbit = 1e-8;  // of the states' sizes: two states of one orbit

// The largest component of a difference of states, in their sizes.
double distance_of(const VectorXd& difference, const VectorXd& sizes) {
  return difference.cwiseQuotient(sizes).cwiseAbs().maxCoeff();
}

// What sizes of all states become in each of them, at most.
VectorXd carried(const VectorXd& sizes, const MatrixXd& monodromy) {
  return monodromy.cwiseAbs() * sizes;
}

// The smallest divisor of the orbit's period after which the state is back.
std::size_t min_period(const PeriodMap& map, const Orbit& orbit) {
  VectorXd state = orbit.state;
  for (std::size_t divisor = 1; divisor < orbit.period; ++divisor) {
    const std::optional<VectorXd> next = map.advance(state, 1);
    if (!next) break;
    state = *next;
    if (orbit.period % divisor == 0 && distance_of(state - orbit.state, orbit.sizes) < kSameOrbit) {
      return divisor;
    }
  }
  return orbit.period;
}

RunError left_range() {
  return RunError("the trajectory left the finite range while an orbit was looked for");
}

// The states at phase 0 of a trajectory, its start first.
std::vector<VectorXd> section(const PeriodMap& map, const VectorXd& start, std::size_t periods) {
  std::vector<VectorXd> states = {start};
  while (states.size() <= periods) {
    const std::optional<VectorXd> next = map.advance(states.back(), 1);
    if (!next) throw left_range();
    states.push_back(*next);
  }
  return states;
}

// The sizes of states on a trajectory, of which `states` are a section.
VectorXd sizes_of_section(const PeriodMap& map, const std::vector<VectorXd>& states) {
  std::optional<PeriodImage> image = map.linearize(states.back(), 1);
  if (!image) throw left_range();
  for (const VectorXd& state : states) image->extent.take(state);
  return sizes_of(*image);
}

// The smallest period after which the last state of a trajectory repeats an earlier one. Close
// returns come first: a coarse tolerance would take an orbit that has just doubled for the one
// before. 0 when there is none.
std::size_t return_period(const std::vector<VectorXd>& states, const VectorXd& sizes) {
  const VectorXd& last = states.back();
  for (int digits = 9; digits >= 3; --digits) {
    const double tolerance = std::pow(10.0, -digits);
    for (std::size_t period = 1; period < states.size(); ++period) {
      const VectorXd& earlier = states[states.size() - 1 - period];
      if (distance_of(last - earlier, sizes) < tolerance) return period;
    }
  }
  return 0;
}

// The states of a trajectory that the `period`-th iterate moves least, the best first.
std::vector<VectorXd> closest_returns(const std::vector<VectorXd>& states, const VectorXd& sizes,
                                      std::size_t period) {
  std::vector<std::pair<double, std::size_t>> moved;
  for (std::size_t i = 0; i + period < states.size(); ++i) {
    moved.emplace_back(distance_of(states[i + period] - states[i], sizes), i);
  }
  std::sort(moved.begin(), moved.end());
  std::vector<VectorXd> out;
  for (std::size_t i = 0; i < std::min(kGuesses, moved.size()); ++i) {
    out.push_back(states[moved[i].second]);
  }
  return out;
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

const Graze* Orbit::graze_within(const VectorXd& errors) const {
  const Graze* nearest = nullptr;
  double share = 1.0;  // of what the distance is known by
  for (const Graze& graze : grazes) {
    if (!std::isfinite(graze.distance)) continue;
    const double known = graze.gradient.cwiseAbs().dot(errors);
    if (graze.distance >= share * known) continue;
    share = graze.distance / known;
    nearest = &graze;
  }
  return nearest;
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
  Orbit orbit{state,
              period,
              image.monodromy,
              Eigen::Map<const Eigen::VectorXcd>(multipliers.data(),
                                                 static_cast<Eigen::Index>(multipliers.size())),
              image.grazes,
              sizes_of(image),
              image.extent.reach()};
  // A complex pair has one modulus: the member above the real axis comes first.
  std::stable_sort(orbit.multipliers.begin(), orbit.multipliers.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return orbit;
}

VectorXd sizes_of(const PeriodImage& image) {
  const VectorXd swing = image.extent.swing();
  const VectorXd sizes = swing.cwiseMax(kMinSize * image.extent.reach())
                             .cwiseMax(kMinSize * carried(swing, image.monodromy));
  return sizes.unaryExpr([](double size) { return size > 0.0 ? size : 1.0; });
}

VectorXd rounding_sizes(const PeriodImage& image, const VectorXd& sizes) {
  const VectorXd reach = image.extent.reach();
  return sizes.cwiseMax(reach).cwiseMax(kCarried * carried(reach, image.monodromy));
}

double stretch_of(const MatrixXd& matrix, const VectorXd& sizes) {
  return (sizes.cwiseInverse().asDiagonal() * matrix * sizes.asDiagonal()).cwiseAbs().maxCoeff();
}

std::optional<Orbit> shoot(const PeriodMap& map, const VectorXd& guess, std::size_t period) {
  const MatrixXd identity = MatrixXd::Identity(guess.size(), guess.size());
  VectorXd state = guess;
  std::optional<PeriodImage> image = map.linearize(state, period);
  if (!image) return std::nullopt;
  const VectorXd sizes = sizes_of(*image);
  for (int iteration = 0; image && iteration < kMaxIterations; ++iteration) {
    const VectorXd residual = image->state - state;
    if (distance_of(residual, rounding_sizes(*image, sizes)) <= kResidual) {
      return make_orbit(state, *image, period);
    }
    const double before = distance_of(residual, sizes);
    const VectorXd step = (image->monodromy - identity).fullPivLu().solve(-residual);
    std::optional<PeriodImage> next;
    double damping = 1.0;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, damping *= 0.5) {
      next = map.linearize(state + damping * step, period);
      if (next && distance_of(next->state - (state + damping * step), sizes) < before) break;
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
  const VectorXd sizes = sizes_of_section(map, states);
  const std::size_t wanted = period ? *period : return_period(states, sizes);
  if (wanted == 0) {
    throw RunError(
        fmt::format("the trajectory does not repeat itself within {} periods: it is chaotic, or "
                    "not settled (raise integrate.settle). An unstable orbit inside chaos can be "
                    "found with --period",
                    kLongestPeriod));
  }
  const std::vector<VectorXd> guesses =
      period ? closest_returns(states, sizes, wanted) : std::vector<VectorXd>{states.back()};
  std::optional<Orbit> found;
  for (std::size_t i = 0; !found && i < guesses.size(); ++i) found = shoot(map, guesses[i], wanted);
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
