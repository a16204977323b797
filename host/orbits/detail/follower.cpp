#include "orbits/detail/follower.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "orbits/find_orbit.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxCorrections = 12;
constexpr double kCorrected = 1e-12;  // residual, of the states' sizes
constexpr double kHardlyMoves = 0.1;  // of what a state changes along the range
constexpr double kMostSteps = 4.0;    // times those of the first cycle
constexpr double kDifference = 1e-6;  // of the range: step of the derivative by the parameter
constexpr double kFar = 1.0;          // of an orbit without a half

OrbitForm with_steps(OrbitForm form, std::size_t coarseness) {
  form.steps = std::max<std::size_t>(form.steps / coarseness, 1);
  return form;
}

}  // namespace

Follower::Follower(const FollowRequest& request, const Orbit& start, std::size_t coarseness)
    : request_(request),
      coarseness_(coarseness),
      range_(request.to - request.from),
      form_(with_steps(form_of(start), coarseness)),
      first_steps_(static_cast<double>(form_.steps)),
      step_(start.duration / first_steps_),
      sizes_(start.sizes),
      widest_(start.sizes),
      states_{start.state, start.state} {
  if (start.kind != OrbitKind::forced && !request.is_at_bifurcation) sizes_ = sizes_along(start);
}

VectorXd Follower::sizes_along(const Orbit& start) const {
  const double parameter = request_.setting.parameters[request_.parameter];
  const Shooting shot = shooting();
  const VectorXd z = shot.unknowns_of(start);
  const PeriodMap map = map_at(parameter);
  const auto at = shot.at(map, z, shot.plane_at(map, z));
  const std::optional<VectorXd> slope = by_parameter(parameter, z);
  VectorXd change = VectorXd::Zero(sizes_.size());
  if (at && slope) {
    VectorXd wanted = VectorXd::Zero(z.size());
    wanted.head(slope->size()) = -*slope;
    const VectorXd solved = at->slope.fullPivLu().solve(wanted) * range_;
    if (solved.allFinite()) change = sizes_.cwiseProduct(solved.head(sizes_.size())).cwiseAbs();
  }
  VectorXd sizes = start.sizes.cwiseMax(kHardlyMoves * change);
  if (start.kind == OrbitKind::equilibrium) {
    sizes = change.cwiseMax(kMinSize * start.sizes);
    sizes = spread_of(sizes, start.monodromy, kMadeOfOthers);
  }
  return above_zero(sizes);
}

BranchPoint Follower::grow_to(const BranchPoint& s) {
  const VectorXd before = sizes_;
  const double time_before = form_.time;
  if (form_.kind == OrbitKind::equilibrium) {
    states_.take(s.orbit.state);
    sizes_ = sizes_.cwiseMax(2.0 * states_.swing());
  } else {
    sizes_ = sizes_.cwiseMax(s.orbit.sizes);
    widest_ = widest_.cwiseMax(s.orbit.sizes);
  }
  if (form_.kind == OrbitKind::cycle) {
    form_.time = s.orbit.duration;
    // Steps hardly get longer, so far as that is worth its time.
    const double wanted = std::min(s.orbit.duration / step_, kMostSteps * first_steps_);
    form_.steps = std::max(form_.steps, static_cast<std::size_t>(std::ceil(wanted)));
  }
  const auto told = [&](const VectorXd& z) {
    VectorXd out = z;
    out.head(sizes_.size()).array() *= before.array() / sizes_.array();
    if (form_.kind == OrbitKind::cycle) out[sizes_.size()] *= time_before / form_.time;
    return out;
  };
  return {told(s.z), told(s.tangent).normalized(), s.orbit, s.iterations};
}

std::optional<BranchPoint> Follower::start(const Orbit& orbit) const {
  return start(orbit, request_.setting.parameters[request_.parameter], request_.upwards);
}

std::optional<BranchPoint> Follower::start_elsewhere(const BranchPoint& s) const {
  const Orbit moved = away_from_surfaces(map_at(parameter_of(s)), s.orbit);
  if (moved.state == s.orbit.state) return std::nullopt;
  return start(moved, parameter_of(s), s.tangent[s.tangent.size() - 1] > 0.0);
}

std::optional<BranchPoint> Follower::start(const Orbit& orbit, double parameter,
                                           bool upwards) const {
  const VectorXd unknowns = shooting().unknowns_of(orbit);
  VectorXd z(unknowns.size() + 1);
  z << unknowns, parameter / range_;
  VectorXd along = VectorXd::Zero(z.size());
  along[z.size() - 1] = upwards ? 1.0 : -1.0;
  return correct(z, along);
}

double Follower::half_return(const BranchPoint& s) const {
  std::optional<VectorXd> half;
  const PeriodMap map = map_at(parameter_of(s));
  if (form_.kind == OrbitKind::forced && form_.period % 2 == 0) {
    half = map.advance(s.orbit.state, form_.period / 2);
  } else if (form_.kind == OrbitKind::cycle) {
    half = map.advance(s.orbit.state, TimeSpan{0.5 * s.orbit.duration, (form_.steps + 1) / 2});
  }
  return half ? distance_of(map.difference(*half, s.orbit.state), sizes_) : kFar;
}

double Follower::extent_of(const BranchPoint& s) const {
  return distance_of(s.orbit.sizes, widest_);
}

std::optional<BranchPoint> Follower::correct(const VectorXd& guess, const VectorXd& along) const {
  VectorXd z = guess;
  const Shooting shot = shooting();
  const Index unknowns = shot.unknowns();
  if (!allowed(guess[unknowns] * range_)) return std::nullopt;
  const PhasePlane plane = shot.plane_at(map_at(guess[unknowns] * range_), guess.head(unknowns));
  for (int iteration = 0; iteration <= kMaxCorrections; ++iteration) {
    const double parameter = z[unknowns] * range_;
    if (!allowed(parameter)) return std::nullopt;
    const PeriodMap map = map_at(parameter);
    const auto at = shot.at(map, z.head(unknowns), plane);
    const std::optional<VectorXd> slope = by_parameter(parameter, z.head(unknowns));
    if (!at || !slope) return std::nullopt;
    MatrixXd bordered = MatrixXd::Zero(unknowns + 1, unknowns + 1);
    bordered.topLeftCorner(unknowns, unknowns) = at->slope;
    bordered.topRightCorner(slope->size(), 1) = range_ * *slope;
    bordered.bottomRows(1) = along.transpose();
    const Eigen::FullPivLU<MatrixXd> solver(bordered);
    VectorXd residual(unknowns + 1), allowed_residual(unknowns + 1);
    residual << at->residual, along.dot(z - guess);
    allowed_residual << kCorrected * at->rounding, kCorrected;
    if ((residual.cwiseAbs().array() <= allowed_residual.array()).all()) {
      const VectorXd tangent = solver.solve(VectorXd::Unit(unknowns + 1, unknowns));
      return BranchPoint{z, tangent.normalized(), shot.orbit_at(map, z.head(unknowns), at->image),
                         iteration};
    }
    z -= solver.solve(residual);
    if (!z.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

ModelSetting Follower::setting_at(double parameter) const {
  ModelSetting setting = request_.setting;
  setting.parameters[request_.parameter] = parameter;
  return setting;
}

bool Follower::allowed(double parameter) const {
  const ParameterInfo& info = request_.model->parameters[request_.parameter];
  return parameter >= info.min && parameter <= info.max &&
         request_.model->check(setting_at(parameter)).empty();
}

PeriodMap Follower::map_at(double parameter) const {
  return {*request_.model, setting_at(parameter), request_.steps / coarseness_, request_.stop};
}

std::optional<VectorXd> Follower::by_parameter(double parameter, const VectorXd& z) const {
  // A cycle may change much faster than a range that it does not fill.
  const double step = (form_.kind == OrbitKind::forced ? kDifference : 0.01 * kDifference) * range_;
  const double high = allowed(parameter + step) ? step : 0.0;
  const double low = allowed(parameter - step) ? step : 0.0;
  const std::optional<VectorXd> after = shooting().image(map_at(parameter + high), z);
  const std::optional<VectorXd> before = shooting().image(map_at(parameter - low), z);
  if (!after || !before) return std::nullopt;
  return (*after - *before) / (high + low);
}

}  // namespace gearsweep
