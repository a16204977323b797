#include "orbits/continuation.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "orbits/orbit_error.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Arclength is measured in sizes of states, the largest met so far, and in parameter ranges.
constexpr double kFirstStep = 2e-3, kMaxStep = 0.02, kMinStep = 1e-7;
constexpr std::size_t kMaxOrbits = 4000;
constexpr int kMaxCorrections = 12;
constexpr int kQuickCorrection = 4;      // so many iterations or fewer: the next step is longer
constexpr double kCorrected = 1e-12;     // residual, of the states' sizes
constexpr double kBracket = 1e-6;        // arclength around a bifurcation
constexpr double kLineRounding = 1e-11;  // of the range: what the straight line leaves
constexpr double kGrazing = 10.0;        // brackets: so near to a limit the motion may touch or not
constexpr double kJustDoubled = 1e-3;    // half_return of an orbit that has only just doubled
constexpr double kHalved = 1e-9;         // half_return of an orbit of half the period
constexpr double kStraight = 0.9;        // smallest cosine of the angle between neighbours
constexpr double kFarLanding = 0.3;      // correction, as a share of the step
constexpr double kDifference = 1e-6;     // of the range: step of the derivative by the parameter

// A solution of shooting: the state and, as the last entry, the parameter, both scaled; with the
// unit tangent of the branch and the signs that tell bifurcations.
struct Solution {
  VectorXd z, tangent;
  Orbit orbit;
  int iterations = 0;
};

class Follower {
 public:
  Follower(const FollowRequest& request, const Orbit& start, std::size_t steps)
      : request_(request),
        steps_(steps),
        period_(start.period),
        sizes_(start.sizes),
        range_(request.to - request.from) {}

  double parameter_of(const Solution& s) const { return s.z[s.z.size() - 1] * range_; }
  double range() const { return range_; }
  const VectorXd& sizes() const { return sizes_; }

  // Takes over the sizes of an orbit where they are larger; the solution in them.
  Solution grow_to(const Solution& s) {
    const VectorXd before = sizes_;
    sizes_ = sizes_.cwiseMax(s.orbit.sizes);
    const auto told = [&](const VectorXd& z) {
      VectorXd out = z;
      out.head(sizes_.size()).array() *= before.array() / sizes_.array();
      return out;
    };
    return {told(s.z), told(s.tangent).normalized(), s.orbit, s.iterations};
  }

  std::optional<Solution> start(const Orbit& orbit) const {
    const double parameter = request_.setting.parameters[request_.parameter];
    VectorXd z(orbit.state.size() + 1);
    z << orbit.state.cwiseQuotient(sizes_), parameter / range_;
    VectorXd along = VectorXd::Zero(z.size());
    along[z.size() - 1] = request_.upwards ? 1.0 : -1.0;
    return correct(z, along);
  }

  // How far half the period is from bringing the orbit back; far when the period is odd.
  double half_return(const Solution& s) const {
    const double far = 1.0;
    if (period_ % 2 != 0) return far;
    const std::optional<VectorXd> half =
        map_at(parameter_of(s)).advance(s.orbit.state, period_ / 2);
    return half ? (*half - s.orbit.state).cwiseQuotient(sizes_).cwiseAbs().maxCoeff() : far;
  }

  // The solution on the plane through `guess` across `along`. Its tangent points along `along`.
  std::optional<Solution> correct(const VectorXd& guess, const VectorXd& along) const {
    VectorXd z = guess;
    const Index states = z.size() - 1;
    for (int iteration = 0; iteration <= kMaxCorrections; ++iteration) {
      const VectorXd state = sizes_.cwiseProduct(z.head(states));
      if (!allowed(z[states] * range_)) return std::nullopt;
      const std::optional<PeriodImage> image = map_at(z[states] * range_).linearize(state, period_);
      const std::optional<VectorXd> slope = by_parameter(z[states] * range_, state);
      if (!image || !slope) return std::nullopt;
      MatrixXd bordered(states + 1, states + 1);
      bordered.topLeftCorner(states, states) =
          sizes_.cwiseInverse().asDiagonal() * image->monodromy * sizes_.asDiagonal();
      bordered.topLeftCorner(states, states).diagonal().array() -= 1.0;
      bordered.topRightCorner(states, 1) = range_ * slope->cwiseQuotient(sizes_);
      bordered.bottomRows(1) = along.transpose();
      const Eigen::FullPivLU<MatrixXd> solver(bordered);
      VectorXd residual(states + 1);
      residual << (image->state - state).cwiseQuotient(sizes_), along.dot(z - guess);
      VectorXd allowed_residual = VectorXd::Constant(states + 1, kCorrected);
      allowed_residual.head(states).array() *=
          rounding_sizes(*image, sizes_).array() / sizes_.array();
      if ((residual.cwiseAbs().array() <= allowed_residual.array()).all()) {
        VectorXd tangent = solver.solve(VectorXd::Unit(states + 1, states));
        return Solution{z, tangent.normalized(), make_orbit(state, *image, period_), iteration};
      }
      z -= solver.solve(residual);
      if (!z.allFinite()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  ModelSetting setting_at(double parameter) const {
    ModelSetting setting = request_.setting;
    setting.parameters[request_.parameter] = parameter;
    return setting;
  }

  bool allowed(double parameter) const {
    const ParameterInfo& info = request_.model->parameters[request_.parameter];
    return parameter >= info.min && parameter <= info.max &&
           request_.model->check(setting_at(parameter)).empty();
  }

  PeriodMap map_at(double parameter) const {
    return PeriodMap(*request_.model, setting_at(parameter), steps_, request_.stop);
  }

  // Derivative of the map by the parameter, by central differences (inside the allowed range). It
  // steers the iteration and is no part of what it converges to.
  std::optional<VectorXd> by_parameter(double parameter, const VectorXd& state) const {
    const double high = allowed(parameter + kDifference * range_) ? kDifference * range_ : 0.0;
    const double low = allowed(parameter - kDifference * range_) ? kDifference * range_ : 0.0;
    const std::optional<VectorXd> after = map_at(parameter + high).advance(state, period_);
    const std::optional<VectorXd> before = map_at(parameter - low).advance(state, period_);
    if (!after || !before) return std::nullopt;
    return (*after - *before) / (high + low);
  }

  const FollowRequest& request_;
  std::size_t steps_;
  std::size_t period_;
  VectorXd sizes_;
  double range_;
};

// Functions of an orbit that change sign where a multiplier crosses the unit circle.
double at_plus_one(const Solution& s) {
  const MatrixXd& m = s.orbit.monodromy;
  return (m - MatrixXd::Identity(m.rows(), m.cols())).determinant();
}
double at_minus_one(const Solution& s) {
  const MatrixXd& m = s.orbit.monodromy;
  return (m + MatrixXd::Identity(m.rows(), m.cols())).determinant();
}
// Product of (m_i m_j - 1) over all pairs: also changes sign where two real multipliers are each
// other's inverse, which is no bifurcation.
double at_pair(const Solution& s) {
  const Eigen::VectorXcd& m = s.orbit.multipliers;
  std::complex<double> product = 1.0;
  for (Index i = 0; i < m.size(); ++i) {
    for (Index j = i + 1; j < m.size(); ++j) product *= m[i] * m[j] - 1.0;
  }
  return product.real();
}
// The parameter's part of the tangent: changes sign where the branch turns back.
double turning(const Solution& s) { return s.tangent[s.tangent.size() - 1]; }

using Test = double (*)(const Solution&);

bool changes(Test test, const Solution& a, const Solution& b) {
  return (test(a) < 0.0) != (test(b) < 0.0);
}

// Neighbours on a branch with a test function's zero between them, and where it is.
struct Bracket {
  Solution low, high;
  double parameter = 0.0;
  double error = 0.0;
  bool grazing = false;
};

// Where the straight line through a test function at two solutions is zero.
double zero_parameter(const Follower& follower, Test test, const Solution& a, const Solution& b) {
  const double share = test(a) / (test(a) - test(b));
  return (1.0 - share) * follower.parameter_of(a) + share * follower.parameter_of(b);
}

// How far the parameter of a bracket may be off: by what it changes with the map of `coarser`.
// Where the motion grazes a limit of the backlash the test function is no straight line, and all
// that is known is the bracket.
void estimate_error(const Follower& coarser, Test test, Bracket* bracket) {
  const VectorXd direction = (bracket->high.z - bracket->low.z).normalized();
  const std::optional<Solution> low = coarser.correct(bracket->low.z, direction);
  const std::optional<Solution> high = coarser.correct(bracket->high.z, direction);
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

// Halves the arclength between two solutions down to kBracket and then draws a straight line. Going
// on to the zero itself would gain nothing, and where branches cross there is no unique solution to
// find there.
std::optional<Bracket> locate(const Follower& follower, const Follower& coarser, Test test,
                              const Solution& a, const Solution& b) {
  Bracket bracket{a, b};
  const VectorXd direction = (b.z - a.z).normalized();
  while ((bracket.high.z - bracket.low.z).norm() > kBracket) {
    const VectorXd middle = 0.5 * (bracket.low.z + bracket.high.z);
    std::optional<Solution> next = follower.correct(middle, direction);
    if (!next) return std::nullopt;
    (changes(test, bracket.low, *next) ? bracket.high : bracket.low) = *std::move(next);
  }
  bracket.parameter = zero_parameter(follower, test, bracket.low, bracket.high);
  estimate_error(coarser, test, &bracket);
  return bracket;
}

// Adds the bifurcations between two neighbours of a branch; false when the branch begins there.
bool add_bifurcations(const Follower& follower, const Follower& coarser,
                      const FollowRequest& request, const Solution& a, const Solution& b,
                      Branch* branch) {
  const auto add = [&](Bifurcation kind, Test test, std::size_t born_of = 0) {
    const std::optional<Bracket> found = locate(follower, coarser, test, a, b);
    if (!found || found->parameter < request.from || found->parameter > request.to) return;
    if (kind == Bifurcation::neimark_sacker &&
        nearest_bifurcation(found->low.orbit).kind != Bifurcation::neimark_sacker) {
      return;
    }
    branch->bifurcations.push_back(
        {kind, found->parameter, found->error, found->low.orbit, found->grazing, born_of});
  };
  if (changes(at_minus_one, a, b)) add(Bifurcation::flip, at_minus_one);
  if (changes(at_pair, a, b)) add(Bifurcation::neimark_sacker, at_pair);
  const bool turns = changes(turning, a, b);
  if (changes(at_plus_one, a, b)) {
    add(turns ? Bifurcation::fold : Bifurcation::branching, turns ? turning : at_plus_one);
  } else if (turns) {
    // The multiplier only touched +1: the branch was born here out of another, and goes back along
    // its own image.
    const std::optional<Bracket> birth = locate(follower, coarser, turning, a, b);
    const bool doubled = birth && follower.half_return(birth->low) < kJustDoubled;
    const std::size_t period = a.orbit.period;
    add(doubled ? Bifurcation::flip : Bifurcation::branching, turning,
        doubled ? period / 2 : period);
    return false;
  }
  return true;
}

}  // namespace

Branch follow_orbit(const FollowRequest& request, const Orbit& start) {
  const std::string& name = request.model->parameters[request.parameter].name;
  Follower follower(request, start, request.steps);
  Follower coarser(request, start, request.steps / 2);
  Branch branch;
  branch.upwards = request.upwards;
  std::optional<Solution> last = follower.start(start);
  if (!last) {
    branch.ended = "Newton's method failed at the start";
    return branch;
  }
  branch.orbits.push_back({follower.parameter_of(*last), last->orbit});
  double length = kFirstStep;
  while (branch.orbits.size() < kMaxOrbits) {
    const VectorXd guess = last->z + length * last->tangent;
    const std::optional<Solution> next = follower.correct(guess, last->tangent);
    // A sharp bend, a far landing or a shorter period may be another branch.
    if (!next || next->tangent.dot(last->tangent) < kStraight ||
        (next->z - guess).norm() > kFarLanding * length || follower.half_return(*next) < kHalved) {
      length *= 0.5;
      if (length < kMinStep) {
        branch.ended =
            fmt::format("no smooth way on from {} = {:.8g}", name, follower.parameter_of(*last));
        return branch;
      }
      continue;
    }
    if (!add_bifurcations(follower, coarser, request, *last, *next, &branch)) {
      branch.ended =
          fmt::format("the branch begins near {} = {:.8g}", name, follower.parameter_of(*next));
      return branch;
    }
    last = follower.grow_to(*next);
    coarser.grow_to(*next);
    const double parameter = follower.parameter_of(*last);
    if (parameter < request.from || parameter > request.to) {
      branch.ended = fmt::format("reached {} = {:.8g}", name,
                                 parameter < request.from ? request.from : request.to);
      return branch;
    }
    branch.orbits.push_back({parameter, last->orbit});
    if (last->iterations <= kQuickCorrection) length = std::min(1.5 * length, kMaxStep);
  }
  branch.ended = fmt::format("stopped after {} orbits at {} = {:.8g}", kMaxOrbits, name,
                             follower.parameter_of(*last));
  return branch;
}

}  // namespace gearsweep
