#include "orbits/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "orbits/detail/branch_test.hpp"

namespace gearsweep {
namespace {

using Eigen::VectorXd;

// Arclength is measured in sizes of states, the largest met so far, in lengths of a cycle and in
// parameter ranges.
constexpr double kFirstStep = 2e-3, kMaxStep = 0.02, kMinStep = 1e-7;
constexpr std::size_t kMaxOrbits = 4000;
constexpr int kQuickCorrection = 4;    // so many iterations or fewer: the next step is longer
constexpr double kJustDoubled = 1e-3;  // half_return of an orbit that has only just doubled
constexpr double kStraight = 0.9;      // smallest cosine of the angle between neighbours
constexpr double kFarLanding = 0.3;    // correction, as a share of the step
constexpr double kSmallCycle = 2e-3;   // of the largest cycle: near its birth
constexpr double kShrinking = 0.6;     // a step makes a cycle no smaller than that
constexpr double kAlong = 1e-3;        // off 1, of the multiplier along a cycle
constexpr double kMostSlack = 0.01;    // multipliers tell nothing then
// Shares of the range: what rounding makes of a parameter that stays; and the arclength from a fold
// to where its parameter has changed by more.
constexpr double kOneValue = 1e-10, kApart = 1e-4;
constexpr double kLonger = 3.0;      // lengths of the first one: worth telling
constexpr double kUnstable = 300.0;  // a multiplier that is worth telling
constexpr double kLongCycle = 30.0;  // lengths of the first one

class BranchSearch {
 public:
  BranchSearch(const FollowRequest& request, const Orbit& start)
      : request_(request),
        name_(request.model->parameters[request.parameter].name),
        first_(start),
        follower_(request, start, 1),
        coarser_(request, start, 2) {
    branch_.upwards = request.upwards;
  }

  Branch follow(const Orbit& start) {
    std::optional<BranchPoint> last = follower_.start(start);
    if (!last) return ended("Newton's method failed at the start");
    add_orbit(*last);
    double length = kFirstStep;
    std::size_t begun_at = 0;  // orbits, when the last of them was begun at another moment
    while (branch_.orbits.size() < kMaxOrbits) {
      const std::optional<BranchPoint> next = step(*last, length);
      if (!next) {
        length *= 0.5;
        if (length >= kMinStep) continue;
        const bool has_gone_on = begun_at < branch_.orbits.size();
        const auto elsewhere = has_gone_on ? follower_.start_elsewhere(*last) : std::nullopt;
        if (!elsewhere) return ended_without_way(*last);
        last = elsewhere;
        length = kFirstStep;
        begun_at = branch_.orbits.size();
        continue;
      }
      if (!add_bifurcations(*last, *next)) return ended_at("the branch begins near", *next);
      if (is_small(*next)) {
        return ended_at(add_birth(*next)
                            ? "the cycle shrinks to an equilibrium near"
                            : "the cycle shrinks to nothing, and no Hopf bifurcation of "
                              "an equilibrium is found, near",
                        *next);
      }
      last = follower_.grow_to(*next);
      coarser_.grow_to(*next);
      const double parameter = follower_.parameter_of(*last);
      if (parameter < request_.from || parameter > request_.to) {
        return ended(fmt::format("reached {} = {:.8g}", name_,
                                 parameter < request_.from ? request_.from : request_.to));
      }
      add_orbit(*last);
      if (last->orbit.duration > kLongCycle * first_.duration) {
        return ended_at(
            fmt::format("a turn takes {:.0f} times as long as at the start (it nears a homoclinic "
                        "orbit?) at",
                        last->orbit.duration / first_.duration),
            *last);
      }
      if (last->iterations <= kQuickCorrection) length = std::min(1.5 * length, kMaxStep);
    }
    return ended_at(fmt::format("stopped after {} orbits at", kMaxOrbits), *last);
  }

 private:
  Branch ended(const std::string& why) {
    branch_.ended = why;
    return std::move(branch_);
  }
  Branch ended_at(const std::string& why, const BranchPoint& s) {
    return ended(fmt::format("{} {} = {:.8g}", why, name_, follower_.parameter_of(s)));
  }

  void add_orbit(const BranchPoint& s) {
    branch_.orbits.push_back({follower_.parameter_of(s), s.orbit});
    if (request_.each_orbit) request_.each_orbit(branch_);
  }

  Branch ended_without_way(const BranchPoint& last) {
    const double longer = first_.duration > 0.0 ? last.orbit.duration / first_.duration : 1.0;
    const double grown =
        last.orbit.multipliers.size() > 0 ? last.orbit.multipliers.cwiseAbs().maxCoeff() : 0.0;
    if (first_.kind != OrbitKind::equilibrium && grown > kUnstable) {
      return ended_at(fmt::format("a neighbour of the orbit is {:.1g} times as far off after a "
                                  "turn, which shooting may not hold; no way on is found from",
                                  grown),
                      last);
    }
    if (longer < kLonger) return ended_at("no smooth way on from", last);
    return ended_at(
        fmt::format("a turn takes {:.3g} times as long as at the start, and no way on is "
                    "found (it nears an equilibrium, or a homoclinic orbit?) from",
                    longer),
        last);
  }

  // The next orbit. A sharp bend, a far landing or a shorter period may be another branch.
  std::optional<BranchPoint> step(const BranchPoint& last, double length) const {
    const VectorXd guess = last.z + length * last.tangent;
    std::optional<BranchPoint> next = follower_.correct(guess, last.tangent);
    if (!next || next->tangent.dot(last.tangent) < kStraight ||
        (next->z - guess).norm() > kFarLanding * length || follower_.half_return(*next) < kHalved) {
      return std::nullopt;
    }
    // Where the multiplier along a cycle is not 1 it is none, or has too few steps.
    if (next->orbit.along && std::fabs(*next->orbit.along - 1.0) > kAlong) return std::nullopt;
    if (next->orbit.slack > kMostSlack) return std::nullopt;
    // Beyond its birth a cycle is the same again, half a turn later.
    if (first_.kind == OrbitKind::cycle &&
        follower_.extent_of(*next) < kShrinking * follower_.extent_of(last)) {
      return std::nullopt;
    }
    return next;
  }

  void add(Bifurcation kind, BranchTest test, const BranchPoint& a, const BranchPoint& b,
           std::size_t born_of = 0) {
    const std::optional<Bracket> found = locate(follower_, coarser_, test, a, b);
    if (!found || found->parameter < request_.from || found->parameter > request_.to) return;
    if (test == at_pair && !is_pair_complex(found->low.orbit)) return;
    // A family of cycles, as about a center, stays at one value of the parameter: it does not turn.
    const auto stays = [&](const BranchPoint& s) {
      return std::fabs(follower_.parameter_of(s) - found->parameter) <=
                 kOneValue * follower_.range() &&
             (s.z - found->low.z).norm() > kApart;
    };
    if (test == turning && (stays(a) || stays(b))) return;
    branch_.bifurcations.push_back({kind, found->parameter, found->error, found->low.orbit,
                                    found->grazing, born_of, way_of(found->low)});
  }

  // The tangent in the states' and the parameter's own units.
  VectorXd way_of(const BranchPoint& s) const {
    const Eigen::Index states = follower_.sizes().size();
    VectorXd way(states + 1);
    way << s.tangent.head(states).cwiseProduct(follower_.sizes()),
        s.tangent[s.tangent.size() - 1] * follower_.range();
    return way;
  }

  static bool crosses(BranchTest test, const BranchPoint& a, const BranchPoint& b) {
    return changes(test, a, b) && is_told(test, a, b);
  }

  // Adds the bifurcations between two neighbours; false when the branch begins there.
  bool add_bifurcations(const BranchPoint& a, const BranchPoint& b) {
    const bool rests = first_.kind == OrbitKind::equilibrium;
    if (crosses(at_minus_one, a, b)) add(Bifurcation::flip, at_minus_one, a, b);
    if (crosses(at_pair, a, b)) {
      add(rests ? Bifurcation::hopf : Bifurcation::neimark_sacker, at_pair, a, b);
    }
    const bool turns = changes(turning, a, b);
    if (turns && (changes(at_plus_one, a, b) || !is_told(at_plus_one, a, b))) {
      add(Bifurcation::fold, turning, a, b);
    } else if (crosses(at_plus_one, a, b)) {
      add(Bifurcation::branching, at_plus_one, a, b);
    } else if (turns) {
      // The multiplier only touched +1: the branch was born here out of another, and goes back
      // along its own image.
      const std::optional<Bracket> birth = locate(follower_, coarser_, turning, a, b);
      const bool doubled = birth && follower_.half_return(birth->low) < kJustDoubled;
      const std::size_t period = a.orbit.period;
      add(doubled ? Bifurcation::flip : Bifurcation::branching, turning, a, b,
          doubled ? std::max<std::size_t>(period / 2, 1) : period);
      return false;
    }
    return true;
  }

  // Whether a cycle is as small as one that has just been born.
  bool is_small(const BranchPoint& s) const {
    return first_.kind == OrbitKind::cycle && follower_.extent_of(s) <= kSmallCycle;
  }
  // False where there is none.
  bool add_birth(const BranchPoint& s) {
    const std::optional<Located> birth = locate_birth(follower_, s);
    if (birth && birth->parameter >= request_.from && birth->parameter <= request_.to) {
      branch_.bifurcations.push_back(
          {Bifurcation::hopf, birth->parameter, birth->error, s.orbit, false, 0, way_of(s)});
    }
    return birth.has_value();
  }

  const FollowRequest& request_;
  const std::string& name_;
  const Orbit& first_;
  Follower follower_, coarser_;
  Branch branch_;
};

}  // namespace

Branch follow_orbit(const FollowRequest& request, const Orbit& start) {
  return BranchSearch(request, start).follow(start);
}

}  // namespace gearsweep
