#include "borders/curve_accuracy.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "borders/border_setting.hpp"
#include "borders/curve_distance.hpp"
#include "borders/device_orbit_map.hpp"
#include "borders/host_orbit_map.hpp"
#include "borders/on_threads.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFarFromPoint = 0.1;  // in scaled unknowns
constexpr std::size_t kJudged = 3;     // points of a curve
constexpr double kChange = 1e-6;       // of a parameter's value; of 1 where that is 0

bool is_of_host(const BorderCurve& curve) {
  return curve.kind == BorderKind::grazing || curve.kind == BorderKind::symmetry_breaking;
}

BorderEquations equations_of(const ParameterPlane& plane, const BorderCurve& curve, OrbitMap* map) {
  return {plane, map, curve.kind, curve.period, curve.scale, curve.limit};
}

// How far a place is from the curve's straight line through a point, in pixels.
double pixels_across(const CurveJudge& judge, const BorderPoint& point, const PlanePlace& place) {
  const Index n = point.tangent.size();
  constexpr double kAlong = 1e-4;
  PlanePlace along = point.place;
  for (std::size_t i = 0; i < 2; ++i) {
    along[i] += kAlong * judge.plane.range(i) * point.tangent[n - 2 + static_cast<Index>(i)];
  }
  const PixelPlace from = pixel_place(judge.pixels, point.place),
                   on = pixel_place(judge.pixels, along), to = pixel_place(judge.pixels, place);
  const double x = on[0] - from[0], y = on[1] - from[1], length = std::hypot(x, y);
  const double dx = to[0] - from[0], dy = to[1] - from[1];
  return length > 0.0 ? std::fabs(x * dy - y * dx) / length : std::hypot(dx, dy);
}

std::size_t middle_point(const BorderCurve& curve) {
  std::vector<std::size_t> stable;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (curve.points[i].is_of_stable_motion()) stable.push_back(i);
  }
  return stable.empty() ? curve.points.size() / 2 : stable[stable.size() / 2];
}

// A parameter, and how it is changed to tell what it moves.
struct Change {
  std::size_t parameter;
  double by;
};

std::vector<Change> changes_of(const CurveJudge& judge) {
  const Model& model = *judge.plane.model;
  std::vector<Change> out;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const bool is_axis =
        std::ranges::find(judge.plane.parameters, i) != judge.plane.parameters.end();
    if (is_axis || model.find_derived(i) != nullptr) continue;
    if (!model.uses_parameter(model.parameters[i].name)) continue;
    if (changed_together(model, i).empty()) continue;
    const double value = judge.plane.setting.parameters[i];
    const double by = kChange * (value == 0.0 ? 1.0 : std::fabs(value));
    const double way = value + by <= model.parameters[i].max ? by : -by;
    out.push_back({i, way});
  }
  return out;
}

// What a change of the equations by `residual` moves, across the curve, in shares of the window.
PlanePlace moved(const MatrixXd& slope, const BorderPoint& point, const VectorXd& residual) {
  const Index n = point.tangent.size();
  MatrixXd all(n, n);
  all << slope, point.tangent.transpose();
  VectorXd right = VectorXd::Zero(n);
  right.head(n - 1) = -residual;
  const VectorXd way = Eigen::FullPivLU<MatrixXd>(all).solve(right);
  const Eigen::Vector2d across =
      Eigen::Vector2d(-point.tangent[n - 1], point.tangent[n - 2]).normalized();
  const Eigen::Vector2d out = across.dot(way.tail(2)) * across;
  return {out[0], out[1]};
}

}  // namespace

std::vector<std::size_t> changed_together(const Model& model, std::size_t parameter) {
  if (model.reduction.mirrors.empty()) return {parameter};
  for (const MirrorPairs& mirrored : model.full().mirror_pairs) {
    for (const MirrorPairs::Pair& pair : mirrored.parameters) {
      if (pair.second == parameter) return {};  // it goes with the first
      if (pair.first == parameter) return {pair.first, pair.second};
    }
  }
  return {parameter};
}

void find_step_errors(const CurveJudge& judge, std::vector<BorderCurve>* curves) {
  Study finer = *judge.study;
  finer.integrate.steps_per_period *= 2;
  const std::size_t steps = host_steps(finer);
  DeviceOrbitMap device(std::make_shared<const Study>(std::move(finer)), judge.engine, judge.stop);
  JoinedOrbitMap joined(&device);
  HostOrbitMap host(judge.plane, steps, judge.stop);
  const auto solve = [&](BorderCurve* curve, OrbitMap* map) {
    const BorderEquations equations = equations_of(judge.plane, *curve, map);
    const std::size_t count = curve->points.size();
    for (std::size_t k = 0; k < kJudged; ++k) {
      const BorderPoint& point = curve->points[(2 * k + 1) * count / (2 * kJudged)];
      const std::optional<BorderPoint> found = equations.correct(
          equations.unknowns_of(point), point.tangent, point.critical, kFarFromPoint);
      if (!found) continue;
      const double off = pixels_across(judge, point, found->place);
      if (!(off <= curve->step_error)) curve->step_error = off;  // no number at first
    }
  };
  for (const bool on_host : {false, true}) {
    std::vector<BorderCurve*> own;
    for (BorderCurve& curve : *curves) {
      if (is_of_host(curve) == on_host) own.push_back(&curve);
    }
    OrbitMap* const map = on_host ? static_cast<OrbitMap*>(&host) : &joined;
    for_each_on_threads(own.size(), on_host ? nullptr : &joined,
                        [&](std::size_t i) { solve(own[i], map); });
  }
}

namespace {

// [curve] the slope of its equations at its middle point, which is judged; nothing where it has
// none.
using Slopes = std::vector<std::optional<MatrixXd>>;

Slopes slopes_at_middle(const CurveJudge& judge, OrbitMap* of_device,
                        std::vector<BorderCurve>* curves) {
  const std::size_t count = curves->size();
  JoinedOrbitMap joined(of_device);
  HostOrbitMap host(judge.plane, host_steps(*judge.study), judge.stop);
  Slopes slopes(count);
  for (const bool on_host : {false, true}) {
    OrbitMap* const map = on_host ? static_cast<OrbitMap*>(&host) : &joined;
    for_each_on_threads(count, on_host ? nullptr : &joined, [&](std::size_t i) {
      BorderCurve& curve = (*curves)[i];
      if (is_of_host(curve) != on_host) return;
      curve.judged = middle_point(curve);
      slopes[i] = equations_of(judge.plane, curve, map).slope_at(curve.points[curve.judged]);
      const PlanePlace none = {std::nan(""), std::nan("")};
      curve.gradients.assign(judge.plane.model->parameters.size(), none);
    });
  }
  return slopes;
}

// The residual of each curve at its point, with these values of all parameters.
std::vector<std::optional<VectorXd>> residuals_at(const CurveJudge& judge,
                                                  const ParameterPlane& plane,
                                                  const std::vector<BorderCurve>& curves,
                                                  const Slopes& slopes, OrbitMap* of_device) {
  std::vector<std::optional<VectorXd>> out(curves.size());
  HostOrbitMap of_host(plane, host_steps(*judge.study), judge.stop);
  std::vector<OrbitQuery> queries;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const BorderCurve& curve = curves[i];
    if (!slopes[i] || is_of_host(curve)) continue;
    queries.push_back(equations_of(plane, curve, nullptr).query_of(curve.points[curve.judged]));
    owners.push_back(i);
  }
  std::vector<std::optional<OrbitAnswer>> answers;
  if (!queries.empty()) answers = of_device->answer(queries);
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const BorderCurve& curve = curves[owners[k]];
    if (!answers[k]) continue;
    out[owners[k]] =
        equations_of(plane, curve, nullptr).residual_of(curve.points[curve.judged], *answers[k]);
  }
  for_each_on_threads(curves.size(), nullptr, [&](std::size_t i) {
    const BorderCurve& curve = curves[i];
    if (!slopes[i] || !is_of_host(curve)) return;
    const BorderEquations equations = equations_of(plane, curve, nullptr);
    const BorderPoint& point = curve.points[curve.judged];
    const auto answer = of_host.answer({equations.query_of(point)}).front();
    if (answer) out[i] = equations.residual_of(point, *answer);
  });
  return out;
}

}  // namespace

void find_gradients(const CurveJudge& judge, std::vector<BorderCurve>* curves) {
  DeviceOrbitMap device(judge.study, judge.engine, judge.stop);
  const Slopes slopes = slopes_at_middle(judge, &device, curves);
  const auto before = residuals_at(judge, judge.plane, *curves, slopes, &device);
  for (const Change& change : changes_of(judge)) {
    ParameterPlane plane = judge.plane;
    Study changed = *judge.study;
    for (const std::size_t parameter : changed_together(*judge.plane.model, change.parameter)) {
      plane.setting.parameters[parameter] += change.by;
      changed.setting.parameters[parameter] += change.by;
    }
    if (!plane.is_allowed((*curves)[0].points.front().place)) continue;
    DeviceOrbitMap map(std::make_shared<const Study>(std::move(changed)), judge.engine, judge.stop);
    std::vector<std::optional<VectorXd>> behind;
    try {
      behind = residuals_at(judge, plane, *curves, slopes, &map);
    } catch (const InputError&) {
      continue;  // the model does not take a value so near to its own, or finds no phase grid
    }
    for (std::size_t i = 0; i < curves->size(); ++i) {
      if (!before[i] || !behind[i]) continue;
      BorderCurve& curve = (*curves)[i];
      PlanePlace way =
          moved(*slopes[i], curve.points[curve.judged], (*behind[i] - *before[i]) / change.by);
      for (std::size_t axis = 0; axis < 2; ++axis) way[axis] *= judge.plane.range(axis);
      curve.gradients[change.parameter] = way;
    }
  }
}

}  // namespace gearsweep
