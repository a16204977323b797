#include "borders/border_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Arclength is measured in scaled unknowns: states in their sizes, angles, window ranges.
constexpr double kFirstStep = 2e-3, kMinStep = 2e-5, kMaxStep = 0.1;
constexpr double kShorter = 0.3;  // a step that is tried again
constexpr int kQuickCorrection = 4;
constexpr double kStraight = 0.9;    // smallest cosine of the angle between neighbours
constexpr double kFarLanding = 0.3;  // correction, as a share of the step
constexpr std::size_t kMaxPoints = 2000;
// Around a corner, in shares of the window: how far from it the way on is looked for, in how many
// directions, and the largest cosine of the angle to the way that the curve came.
constexpr double kOverCorner = 3e-3, kFarFromCorner = 0.1, kBackwards = 0.9;
constexpr int kDirections = 16;
constexpr std::size_t kMaxCorners = 12;
constexpr std::size_t kMaxCornersOfGraze = 2;        // the host takes long to look around one
constexpr double kAlmostStraight = 0.998;            // cosine
constexpr double kSamePlace = 3e-4, kAtEdge = 1e-4;  // of the window
constexpr double kNearAxis = 1e-3;  // of the angle of a pair: a resonance ends its curve

class Tracer {
 public:
  Tracer(const BorderEquations& equations, const BorderPoint& start)
      : equations_(equations), start_(start) {}

  // One way; `sign` of the start's tangent.
  std::vector<BorderPoint> go(double sign) {
    std::vector<BorderPoint> points;
    BorderPoint last = start_;
    last.tangent *= sign;
    double length = kFirstStep;
    while (points.size() < kMaxPoints) {
      const double allowed = length_of_step(last, length);
      std::optional<BorderPoint> next = step(last, allowed);
      if (!next) {
        length = kShorter * allowed;
        if (length >= kMinStep) continue;
        if (!is_at_edge(last)) stops_.push_back(last);
        if (turns_ < most_corners()) next = over_corner(last, points);
        if (!next) {
          return ended(is_at_edge(last) ? CurveEnd::window : CurveEnd::no_way_on,
                       std::move(points));
        }
        ++turns_;
        if (bends_at(last, *next)) corners_.push_back(last.place);
        length = kFirstStep;
      }
      if (!equations_.plane().contains(next->place)) {
        if (const auto edge = at_edge(last, *next)) points.push_back(*edge);
        return ended(CurveEnd::window, std::move(points));
      }
      if (is_closed(last, *next, points.size())) {
        is_closed_ = true;
        return ended(CurveEnd::closes, std::move(points));
      }
      const bool is_beyond = has_angle() && std::sin(next->angle) * std::sin(last.angle) < 0.0;
      if (!is_beyond) points.push_back(*next);
      if (equations_.kind() == BorderKind::grazing && settles_no_more(*next)) {
        return ended(CurveEnd::settles_no_more, std::move(points));
      }
      if (is_beyond || meets_axis(*next)) {
        const bool is_front = std::cos(next->angle) > 0.0;
        return ended(is_front ? CurveEnd::resonance_1_1 : CurveEnd::resonance_1_2,
                     std::move(points));
      }
      last = *std::move(next);
      length = last.iterations <= kQuickCorrection ? 1.5 * allowed : allowed;
    }
    return ended(CurveEnd::too_long, std::move(points));
  }

  CurveEnd reason() const { return reason_; }
  const std::vector<PlanePlace>& corners() const { return corners_; }
  const std::vector<BorderPoint>& stops() const { return stops_; }
  bool is_closed() const { return is_closed_; }

 private:
  std::vector<BorderPoint> ended(CurveEnd why, std::vector<BorderPoint> points) {
    reason_ = why;
    return points;
  }

  // No farther than a picture needs it.
  double length_of_step(const BorderPoint& last, double length) const {
    const double in_plane = last.tangent.tail(2).norm();
    const double visible = in_plane > 0.0 ? kMaxCurveStep / in_plane : kMaxStep;
    return std::min({length, visible, kMaxStep});
  }

  std::optional<BorderPoint> step(const BorderPoint& last, double length) const {
    const VectorXd guess = equations_.unknowns_of(last) + length * last.tangent;
    std::optional<BorderPoint> next =
        equations_.correct(guess, last.tangent, last.critical, kFarLanding * length);
    if (!next || next->tangent.dot(last.tangent) < kStraight) return std::nullopt;
    return next;
  }

  // Where an orbit begins to touch a limit of a contact, its multipliers change with the root of
  // how deep it goes: a curve goes on there along the places where the orbit only just touches, at
  // any angle to where it came from. Looks for it all around.
  std::optional<BorderPoint> over_corner(const BorderPoint& corner,
                                         const std::vector<BorderPoint>& points) const {
    const VectorXd from = equations_.unknowns_of(corner);
    const Index x = from.size() - 2, y = x + 1;
    const double came = std::atan2(-corner.tangent[y], -corner.tangent[x]);
    std::optional<BorderPoint> best;
    double most_straight = kBackwards;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      if (std::cos(angle - came) > kBackwards) continue;
      VectorXd across = VectorXd::Zero(from.size()), guess = from;
      across[x] = std::cos(angle);
      across[y] = std::sin(angle);
      guess += kOverCorner * across;
      std::optional<BorderPoint> found =
          equations_.correct(guess, across, corner.critical, kFarFromCorner);
      if (!found) continue;
      const VectorXd gone = equations_.unknowns_of(*found) - from;
      const double turned = std::cos(std::atan2(gone[y], gone[x]) - came);
      if (std::hypot(gone[x], gone[y]) > 2.0 * kOverCorner || turned >= most_straight ||
          was_there(*found, points)) {
        continue;
      }
      if (found->tangent[x] * gone[x] + found->tangent[y] * gone[y] < 0.0) {
        found->tangent = -found->tangent;
      }
      most_straight = turned;
      best = std::move(found);
    }
    return best;
  }

  // Where the curve leaves the window.
  std::optional<BorderPoint> at_edge(const BorderPoint& inside, const BorderPoint& outside) const {
    const ParameterPlane& plane = equations_.plane();
    double share = 1.0;
    std::size_t axis = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      for (const double edge : {plane.from[i], plane.to[i]}) {
        const double way = outside.place[i] - inside.place[i];
        const double at = (edge - inside.place[i]) / way;
        if (at >= 0.0 && at < share) {
          share = at;
          axis = i;
        }
      }
    }
    if (share <= 0.0) return std::nullopt;  // the curve began there
    const VectorXd from = equations_.unknowns_of(inside), to = equations_.unknowns_of(outside);
    const Index n = from.size();
    const VectorXd guess = from + share * (to - from);
    return equations_.correct(guess, VectorXd::Unit(n, n - 2 + static_cast<Index>(axis)),
                              inside.critical, kFarLanding * (to - from).norm());
  }

  // Whether the start lies between two neighbours.
  bool is_closed(const BorderPoint& last, const BorderPoint& next, std::size_t points) const {
    if (points < 4) return false;
    const VectorXd from = equations_.unknowns_of(last), to = equations_.unknowns_of(next);
    const VectorXd way = to - from, start = equations_.unknowns_of(start_) - from;
    const double share = start.dot(way) / way.squaredNorm();
    return share >= 0.0 && share <= 1.0 && (start - share * way).norm() < 0.1 * way.norm();
  }

  bool has_angle() const { return equations_.kind() == BorderKind::neimark_sacker; }
  bool meets_axis(const BorderPoint& point) const {
    return has_angle() && std::abs(std::sin(point.angle)) < kNearAxis;
  }

  std::size_t most_corners() const {
    return equations_.kind() == BorderKind::grazing ? kMaxCornersOfGraze : kMaxCorners;
  }

  // Multipliers change with the root of how deep an orbit goes. Where a motion that settles comes
  // up to the start and the graze itself is unstable, the curve goes on while it hardly gets more
  // so.
  bool settles_no_more(const BorderPoint& point) const {
    const auto beyond_circle = [](const BorderPoint& at) {
      return std::max(0.0, at.multipliers.cwiseAbs().maxCoeff() - 1.0);
    };
    return !point.is_of_stable_motion() && beyond_circle(point) > 2.0 * beyond_circle(start_);
  }

  // In shares of the window.
  double share(const BorderPoint& a, const BorderPoint& b, std::size_t axis) const {
    return (b.place[axis] - a.place[axis]) / equations_.plane().range(axis);
  }

  // Whether the way from a point to the next turns away from the point's tangent. On a smooth model
  // a step that is hard to take is no corner.
  bool bends_at(const BorderPoint& a, const BorderPoint& b) const {
    const double x = share(a, b, 0), y = share(a, b, 1);
    const Index n = a.tangent.size();
    const double tx = a.tangent[n - 2], ty = a.tangent[n - 1];
    return x * tx + y * ty < kAlmostStraight * std::hypot(x, y) * std::hypot(tx, ty);
  }

  // Whether a place lies on the way so far.
  bool was_there(const BorderPoint& point, const std::vector<BorderPoint>& points) const {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double ax = share(points[i], point, 0), ay = share(points[i], point, 1);
      const double bx = share(points[i], points[i + 1], 0), by = share(points[i], points[i + 1], 1);
      const double length = bx * bx + by * by;
      const double at = length > 0.0 ? std::clamp((ax * bx + ay * by) / length, 0.0, 1.0) : 0.0;
      if (std::hypot(ax - at * bx, ay - at * by) < kSamePlace) return true;
    }
    return false;
  }

  // At an edge of the window beyond which the model may take no values.
  bool is_at_edge(const BorderPoint& point) const {
    const ParameterPlane& plane = equations_.plane();
    for (std::size_t i = 0; i < 2; ++i) {
      const double from_edge =
          std::min(point.place[i] - plane.from[i], plane.to[i] - point.place[i]);
      if (from_edge < kAtEdge * plane.range(i)) return true;
    }
    return false;
  }

  const BorderEquations& equations_;
  const BorderPoint& start_;
  CurveEnd reason_ = CurveEnd::no_way_on;
  std::vector<PlanePlace> corners_;
  std::vector<BorderPoint> stops_;
  std::size_t turns_ = 0;
  bool is_closed_ = false;
};

}  // namespace

double BorderCurve::max_residual() const {
  double out = 0.0;
  for (const BorderPoint& point : points) out = std::max(out, point.residual);
  return out;
}

BorderCurve follow_border(const BorderEquations& equations, const BorderPoint& start) {
  BorderCurve curve;
  curve.kind = equations.kind();
  curve.period = equations.period();
  curve.limit = equations.limit();
  curve.scale = equations.scale();
  Tracer onwards(equations, start);
  const std::vector<BorderPoint> after = onwards.go(1.0);
  curve.ends = onwards.reason();
  const Model& model = *equations.plane().model;
  const bool may_touch = !model.contacts.empty() || model.corners > 0 || !model.surfaces.empty();
  const auto add_corners = [&](const Tracer& tracer) {
    if (!may_touch) return;
    curve.stops.insert(curve.stops.end(), tracer.stops().begin(), tracer.stops().end());
    for (const PlanePlace& place : tracer.corners()) {
      curve.special.push_back({SpecialKind::corner, place});
    }
  };
  add_corners(onwards);
  curve.is_closed = onwards.is_closed();
  std::vector<BorderPoint> before;
  if (curve.is_closed) {
    curve.begins = curve.ends;
  } else {
    Tracer back(equations, start);
    before = back.go(-1.0);
    curve.begins = back.reason();
    add_corners(back);
  }
  curve.points.assign(before.rbegin(), before.rend());
  curve.start = before.size();
  curve.points.push_back(start);
  curve.points.insert(curve.points.end(), after.begin(), after.end());
  if (curve.is_closed) curve.points.push_back(start);
  add_special_points(&curve);
  return curve;
}

}  // namespace gearsweep
