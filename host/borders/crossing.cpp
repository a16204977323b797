#include "borders/crossing.hpp"

#include <cmath>
#include <complex>

#include "borders/curve_distance.hpp"

namespace gearsweep {
namespace {

using Eigen::VectorXd;

constexpr double kFarCrossing = 2.0;    // in scaled unknowns: from a pixel to a border beside it
constexpr double kBeyond = 1.5;         // pixels from the middle of an edge
constexpr double kNearestShare = 1e-5;  // of the way between two pixels: how near to its end
constexpr double kNoFold = 1e-4;        // transversality, of which differences leave 1e-6
constexpr double kSmallAngle = 0.02;    // of a pair: a resonance, or none at all
constexpr double kNearReach = 0.5;      // sizes of the states: from one orbit to the next

// The multiplier of the orbit that would make the bifurcation; nothing where none is of its kind.
std::optional<std::complex<double>> critical_multiplier(BorderKind kind, const HeldOrbit& orbit) {
  std::optional<std::complex<double>> out;
  for (const std::complex<double>& m : orbit.multipliers) {
    const bool fits = kind == BorderKind::neimark_sacker ? m.imag() > 0.0
                      : kind == BorderKind::fold         ? m.imag() == 0.0 && m.real() > 0.0
                                                         : m.imag() == 0.0 && m.real() < 0.0;
    if (fits && (!out || std::abs(m) > std::abs(*out))) out = m;
  }
  return out;
}

// Where the line from the orbit's place to `there` meets a border of the orbit.
std::optional<BorderPoint> crossing_on_line(const ParameterPlane& plane,
                                            const BorderEquations& equations,
                                            const HeldOrbit& orbit, const PlanePlace& there) {
  BorderPoint near;
  near.place = orbit.place;
  near.state = orbit.state;
  const std::optional<std::complex<double>> critical = critical_multiplier(equations.kind(), orbit);
  if (!critical) return std::nullopt;
  near.angle = std::arg(*critical);
  const VectorXd guess = equations.unknowns_of(near);
  const std::optional<Critical> vectors = equations.critical_near(guess);
  if (!vectors) return std::nullopt;
  VectorXd across = VectorXd::Zero(guess.size());
  across[guess.size() - 2] = (there[1] - orbit.place[1]) / plane.range(1);
  across[guess.size() - 1] = -(there[0] - orbit.place[0]) / plane.range(0);
  std::optional<BorderPoint> found =
      equations.correct(guess, across.normalized(), *vectors, kFarCrossing);
  if (!found || !found->is_of_stable_motion()) return std::nullopt;
  if (found->transversality < kNoFold) return std::nullopt;
  const bool is_pair = equations.kind() == BorderKind::neimark_sacker;
  if (is_pair && std::abs(std::sin(found->angle)) < kSmallAngle) return std::nullopt;
  return found;
}

}  // namespace

HeldOrbit last_stable(const ParameterPlane& plane, OrbitMap* map, const HeldOrbit& start,
                      const PlanePlace& there) {
  HeldOrbit at = start;
  VectorXd slope = VectorXd::Zero(start.state.size());  // by the share of the way
  double share = 0.0, step = 0.125;
  while (step > kNearestShare && share < 2.0) {
    HeldOrbit guess = at;
    for (std::size_t k = 0; k < 2; ++k) {
      guess.place[k] = start.place[k] + (share + step) * (there[k] - start.place[k]);
    }
    guess.state += step * slope;
    const std::optional<HeldOrbit> next = hold_orbits(plane, map, {guess}, kNearReach).front();
    if (next && next->is_stable()) {
      slope = (next->state - at.state) / step;
      at = *next;
      share += step;
    } else {
      step *= 0.5;
    }
  }
  return at;
}

std::optional<Crossing> find_crossing(const ParameterPlane& plane, const PeriodPixels& pixels,
                                      OrbitMap* map, const HeldOrbit& orbit, std::size_t to,
                                      const BorderEdge& edge) {
  const PixelPlace middle = middle_of(pixels, edge);
  const auto is_beside = [&](const std::optional<BorderPoint>& point) {
    if (!point) return false;
    const PixelPlace at = pixel_place(pixels, point->place);
    return std::hypot(at[0] - middle[0], at[1] - middle[1]) <= kBeyond;
  };
  std::optional<HeldOrbit> nearer;
  for (const BorderKind kind : {BorderKind::flip, BorderKind::fold, BorderKind::neimark_sacker}) {
    const BorderScale scale = {orbit.sizes, {plane.range(0), plane.range(1)}};
    auto equations = std::make_unique<BorderEquations>(plane, map, kind, orbit.period, scale);
    std::optional<BorderPoint> found = crossing_on_line(plane, *equations, orbit, pixels.place(to));
    if (!is_beside(found)) {
      if (!nearer) nearer = last_stable(plane, map, orbit, pixels.place(to));
      found = crossing_on_line(plane, *equations, *nearer, pixels.place(to));
    }
    if (is_beside(found)) return Crossing{std::move(equations), *std::move(found)};
  }
  return std::nullopt;
}

}  // namespace gearsweep
