#include "orbits/detail/branch_test.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "orbits/orbit_error.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::complex;

constexpr double kBracket = 1e-6;  // arclength around a bifurcation
constexpr double kNarrower = 0.9;  // a bracket after each step; else its ends are of two branches
constexpr double kLineRounding = 1e-11;  // of the range: what the straight line leaves
constexpr double kGrazing = 10.0;        // brackets: so near to a limit the motion may touch or not
constexpr double kNearby = 0.1;          // of the range, from a small cycle to its birth
constexpr double kSameTime = 0.2;        // of the length of a small cycle
constexpr double kSlope = 1e-5;          // of the range: step of a derivative
constexpr int kMaxSecants = 30;

// A test's factors where it is a product over multipliers, or eigenvalues in the fastest of them.
std::vector<complex<double>> factors_of(BranchTest test, const Orbit& orbit) {
  const Eigen::VectorXcd& m = orbit.multipliers;
  const bool rests = orbit.kind == OrbitKind::equilibrium;
  const double unit = rests ? form_of(orbit).time : 1.0;
  std::vector<complex<double>> factors;
  for (Index i = 0; i < m.size(); ++i) {
    if (test == at_plus_one) factors.push_back(rests ? unit * m[i] : m[i] - 1.0);
    if (test == at_minus_one && !rests) factors.push_back(m[i] + 1.0);
    for (Index j = i + 1; j < m.size() && test == at_pair; ++j) {
      factors.push_back(rests ? unit * (m[i] + m[j]) : m[i] * m[j] - 1.0);
    }
  }
  return factors;
}

double product_of(BranchTest test, const Orbit& orbit) {
  complex<double> product = 1.0;
  for (const complex<double>& factor : factors_of(test, orbit)) product *= factor;
  return product.real();
}

// Where the straight line through a test function at two solutions is zero.
double zero_parameter(const Follower& follower, BranchTest test, const BranchPoint& a,
                      const BranchPoint& b) {
  const double share = test(a) / (test(a) - test(b));
  return (1.0 - share) * follower.parameter_of(a) + share * follower.parameter_of(b);
}

// How far the parameter of a bracket may be off: by what it changes with the map of `coarser`.
// Where the motion grazes a limit of the backlash the test function is no straight line, and all
// that is known is the bracket.
void estimate_error(const Follower& coarser, BranchTest test, Bracket* bracket) {
  const VectorXd direction = (bracket->high.z - bracket->low.z).normalized();
  const std::optional<BranchPoint> low = coarser.correct(bracket->low.z, direction);
  const std::optional<BranchPoint> high = coarser.correct(bracket->high.z, direction);
  bracket->error = std::numeric_limits<double>::infinity();
  if (!low || !high) return;
  const double again = zero_parameter(coarser, test, *low, *high);
  bracket->grazing =
      bracket->low.orbit.graze_within(kGrazing * kBracket * coarser.sizes()) != nullptr;
  if (!std::isfinite(again)) return;
  bracket->error =
      kErrorPerChange * std::fabs(again - bracket->parameter) + kLineRounding * coarser.range();
  if (!bracket->grazing) return;
  bracket->error +=
      std::fabs(coarser.parameter_of(bracket->high) - coarser.parameter_of(bracket->low));
}

// The real part of the eigenvalue of the equilibrium near `state` whose imaginary part is nearest
// to a frequency. Nothing when there is no equilibrium, or no such frequency.
std::optional<double> growth_at(const PeriodMap& map, const VectorXd& state, double frequency) {
  const std::optional<Orbit> rest = find_equilibrium(map, state);
  if (!rest) return std::nullopt;
  const complex<double>* nearest = nullptr;
  for (const complex<double>& value : rest->multipliers) {
    if (nearest == nullptr ||
        std::fabs(value.imag() - frequency) < std::fabs(nearest->imag() - frequency)) {
      nearest = &value;
    }
  }
  if (std::fabs(nearest->imag() - frequency) > kSameTime * frequency) return std::nullopt;
  return nearest->real();
}

}  // namespace

double at_plus_one(const BranchPoint& s) {
  if (s.orbit.kind != OrbitKind::forced) return product_of(at_plus_one, s.orbit);
  const MatrixXd& m = s.orbit.monodromy;
  return (m - MatrixXd::Identity(m.rows(), m.cols())).determinant();
}

double at_minus_one(const BranchPoint& s) {
  if (s.orbit.kind != OrbitKind::forced) return product_of(at_minus_one, s.orbit);
  const MatrixXd& m = s.orbit.monodromy;
  return (m + MatrixXd::Identity(m.rows(), m.cols())).determinant();
}

double at_pair(const BranchPoint& s) { return product_of(at_pair, s.orbit); }

bool is_pair_complex(const Orbit& orbit) {
  const std::vector<complex<double>> factors = factors_of(at_pair, orbit);
  const auto nearest =
      std::min_element(factors.begin(), factors.end(),
                       [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  std::size_t pair = 0;
  for (Index i = 0; i < orbit.multipliers.size(); ++i) {
    for (Index j = i + 1; j < orbit.multipliers.size(); ++j, ++pair) {
      if (factors.begin() + static_cast<std::ptrdiff_t>(pair) == nearest) {
        return orbit.multipliers[i].imag() != 0.0;
      }
    }
  }
  return false;
}

double turning(const BranchPoint& s) { return s.tangent[s.tangent.size() - 1]; }

bool changes(BranchTest test, const BranchPoint& a, const BranchPoint& b) {
  return (test(a) < 0.0) != (test(b) < 0.0);
}

bool is_told(BranchTest test, const BranchPoint& a, const BranchPoint& b) {
  if (a.orbit.kind == OrbitKind::forced) return true;
  // Rounding of eigenvalues, and errors of a cycle's.
  const double border = a.orbit.kind == OrbitKind::equilibrium
                            ? 1e-9
                            : std::max({1e-6, a.orbit.slack, b.orbit.slack});
  const auto smallest = [&](const BranchPoint& s) {
    double least = 1.0;
    for (const complex<double>& factor : factors_of(test, s.orbit)) {
      least = std::min(least, std::abs(factor));
    }
    return least;
  };
  return std::max(smallest(a), smallest(b)) > border;
}

std::optional<Bracket> locate(const Follower& follower, const Follower& coarser, BranchTest test,
                              const BranchPoint& a, const BranchPoint& b) {
  Bracket bracket{a, b};
  const VectorXd direction = (b.z - a.z).normalized();
  while ((bracket.high.z - bracket.low.z).norm() > kBracket) {
    // In the middle may be where branches cross: Newton's method comes to nothing, or to the branch
    // that this one was born of. Beside it then.
    const double width = (bracket.high.z - bracket.low.z).norm();
    std::optional<BranchPoint> next;
    for (const double share : {0.5, 0.4, 0.6}) {
      next = follower.correct(bracket.low.z + share * (bracket.high.z - bracket.low.z), direction);
      if (next && test == turning && follower.half_return(*next) < kHalved) next.reset();
      if (next) break;
    }
    if (!next) return std::nullopt;
    (changes(test, bracket.low, *next) ? bracket.high : bracket.low) = *std::move(next);
    if ((bracket.high.z - bracket.low.z).norm() > kNarrower * width) return std::nullopt;
  }
  bracket.parameter = zero_parameter(follower, test, bracket.low, bracket.high);
  estimate_error(coarser, test, &bracket);
  return bracket;
}

std::optional<Located> locate_birth(const Follower& follower, const BranchPoint& small_cycle) {
  const double frequency = 2.0 * std::numbers::pi / small_cycle.orbit.duration;
  const double from = follower.parameter_of(small_cycle), range = follower.range();
  const auto growth = [&](double parameter) -> std::optional<double> {
    if (!follower.allowed(parameter) || std::fabs(parameter - from) > kNearby * range) {
      return std::nullopt;
    }
    return growth_at(follower.map_at(parameter), small_cycle.orbit.state, frequency);
  };
  double last = from, parameter = from + kSlope * range;
  std::optional<double> before = growth(last), now = growth(parameter);
  for (int secants = 0; before && now && secants < kMaxSecants; ++secants) {
    const double next = parameter - *now * (parameter - last) / (*now - *before);
    const double left = std::fabs(next - parameter);
    if (left <= kLineRounding * range) return Located{next, 2.0 * kLineRounding * range};
    // Rounding of the eigenvalues may leave more.
    if (secants > kMaxSecants / 2 && left <= kBracket * range) return Located{next, 10.0 * left};
    last = parameter;
    before = now;
    parameter = next;
    now = growth(parameter);
  }
  return std::nullopt;
}

}  // namespace gearsweep
