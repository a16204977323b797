#include "orbits/branch_switch.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "orbits/detail/follower.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Of the critical multiplier: where a bifurcation was bracketed it is as near.
constexpr double kAtBorder = 1e-2;
constexpr double kBesideLanding = 0.5;  // correction of states, as a share of the way to the side
constexpr double kOwnHalf = 0.1;  // how far a doubled orbit's halves are apart, as such a share
constexpr double kTold = 1e-8, kSameBirth = 1e-6;  // of the range
constexpr double kOneWay = 1e-3;                   // sine of the angle between both branches
constexpr double kMinRatio = 1.5, kMaxRatio = 6.0;
// How far aside orbits are looked for, in sizes of states. The nearer, the less another branch is
// met; too near both branches are one.
constexpr std::array<double, 8> kFarAside = {3e-3, 1e-3, 1e-2, 3e-4, 1e-4, 3e-5, 1e-5, 3e-2};

// 0 where it is not known.
double error_of(const LocatedBifurcation& at) { return std::isfinite(at.error) ? at.error : 0.0; }

// The orbit as one of the branch that leaves: of twice the period at a flip.
Orbit of_leaving(const LocatedBifurcation& at) {
  Orbit orbit = at.orbit;
  if (at.kind == Bifurcation::flip) {
    orbit.period *= 2;
    orbit.duration *= 2.0;
    orbit.steps *= 2;
  }
  return orbit;
}

// Where the other branch goes: its tangent, the critical eigenvector in these sizes, which changes
// no parameter, and no cycle's length; and what of it lies across the followed branch, a unit
// vector.
struct Aside {
  VectorXd tangent, across;  // the product of both is 1
};

// Nothing where no multiplier is critical, or both branches go one way as far as can be told.
std::optional<Aside> find_aside(const LocatedBifurcation& at, const VectorXd& sizes, double range) {
  const double critical = at.kind == Bifurcation::flip ? -1.0 : 1.0;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(at.orbit.monodromy);
  if (solver.info() != Eigen::Success) return std::nullopt;
  Index nearest = 0;
  const auto off = [&](Index i) { return std::abs(solver.eigenvalues()[i] - critical); };
  for (Index i = 1; i < solver.eigenvalues().size(); ++i) {
    if (off(i) < off(nearest)) nearest = i;
  }
  if (!(off(nearest) <= kAtBorder)) return std::nullopt;
  const Index states = sizes.size();
  const Index last = states + (at.orbit.kind == OrbitKind::cycle ? 1 : 0);
  VectorXd tangent = VectorXd::Zero(last + 1), followed = VectorXd::Zero(last + 1);
  tangent.head(states) = solver.eigenvectors().col(nearest).real().cwiseQuotient(sizes);
  followed.head(states) = at.way.head(states).cwiseQuotient(sizes);
  followed[last] = at.way[states] / range;
  tangent.normalize();
  followed.normalize();
  const VectorXd across = tangent - tangent.dot(followed) * followed;
  const double apart = across.norm();
  if (!(apart > kOneWay)) return std::nullopt;
  return Aside{tangent / apart, across / apart};
}

}  // namespace

bool has_leaving_branch(const LocatedBifurcation& at) {
  if (at.born_of > 0 || at.orbit.kind == OrbitKind::equilibrium) return false;
  // Of a cycle two multipliers are 1 where branches cross: one eigenvector is not told from the
  // cycle's own direction.
  return at.kind == Bifurcation::flip ||
         (at.kind == Bifurcation::branching && at.orbit.kind == OrbitKind::forced);
}

std::vector<BranchStart> leaving_branches(const FollowRequest& request,
                                          const LocatedBifurcation& at) {
  std::vector<BranchStart> starts;
  FollowRequest beside = request;
  beside.setting.parameters[request.parameter] = at.parameter;
  beside.is_at_bifurcation = true;
  const Orbit orbit = of_leaving(at);
  const Follower follower(beside, orbit, 1);
  const std::optional<Aside> aside = find_aside(at, follower.sizes(), follower.range());
  if (!aside) return starts;
  VectorXd z = VectorXd::Ones(aside->across.size());  // a cycle is told in its own length
  z.head(orbit.state.size()) = orbit.state.cwiseQuotient(follower.sizes());
  z[z.size() - 1] = at.parameter / follower.range();
  const auto beside_by = [&](double far) -> std::optional<BranchPoint> {
    const VectorXd guess = z + far * aside->tangent;
    std::optional<BranchPoint> found = follower.correct(guess, aside->across);
    const double way = std::fabs(far);
    // How far the parameter changes meanwhile depends on the range, and on how steep the branch is.
    const auto landing = [&] {
      const Index parameter = guess.size() - 1;
      return (found->z - guess).head(parameter).norm();
    };
    const bool is_it =
        found && landing() <= kBesideLanding * way &&
        (at.kind != Bifurcation::flip || follower.half_return(*found) > kOwnHalf * way);
    return is_it ? found : std::nullopt;
  };
  const auto change_to = [&](const BranchPoint& s) {
    return follower.parameter_of(s) - at.parameter;
  };
  // Twice as far aside the parameter changes twice as much, where branches cross, or four times as
  // much: what does otherwise is another branch, or rounding, and of linear motions nothing
  // changes.
  const auto add = [&](double far) {
    const std::optional<BranchPoint> found = beside_by(far), farther = beside_by(2.0 * far);
    if (!found || !farther) return false;
    const double change = change_to(*found), ratio = change_to(*farther) / change;
    if (!(std::fabs(change) > kTold * follower.range() + error_of(at))) return false;
    if (!(ratio > kMinRatio && ratio < kMaxRatio)) return false;
    const bool upwards = change > 0.0;
    const bool is_known = std::ranges::find(starts, upwards, &BranchStart::upwards) != starts.end();
    if (!is_known) starts.push_back({follower.parameter_of(*found), found->orbit, upwards});
    return true;
  };
  for (const double side : {1.0, -1.0}) {
    std::ranges::any_of(kFarAside, [&](double far) { return add(side * far); });
  }
  return starts;
}

std::vector<LeavingBranch> follow_leaving(const FollowRequest& request,
                                          const std::vector<Branch>& branches,
                                          std::size_t generations) {
  std::vector<LeavingBranch> found;
  const double same = kSameBirth * (request.to - request.from);
  const auto period_of = [](const LocatedBifurcation& at) { return of_leaving(at).period; };
  // A branch that ended there was born there.
  const auto is_known = [&](const LocatedBifurcation& at) {
    return std::ranges::any_of(found, [&](const LeavingBranch& other) {
      return std::ranges::any_of(other.branches, [&](const Branch& branch) {
        return std::ranges::any_of(branch.bifurcations, [&](const LocatedBifurcation& end) {
          return end.born_of > 0 && end.kind == at.kind && end.orbit.period == period_of(at) &&
                 std::fabs(end.parameter - at.parameter) <= same + error_of(at) + error_of(end);
        });
      });
    });
  };
  const auto add_leaving = [&](std::size_t parent, const std::vector<Branch>& of) {
    for (const Branch& branch : of) {
      for (const LocatedBifurcation& at : branch.bifurcations) {
        if (found.size() == kMaxLeaving || !has_leaving_branch(at) || is_known(at)) continue;
        LeavingBranch leaving{parent, at, period_of(at), {}};
        for (const BranchStart& start : leaving_branches(request, at)) {
          FollowRequest further = request;
          further.setting.parameters[request.parameter] = start.parameter;
          further.upwards = start.upwards;
          further.is_at_bifurcation = true;
          leaving.branches.push_back(follow_orbit(further, start.orbit));
        }
        found.push_back(std::move(leaving));
      }
    }
  };
  std::size_t first = 0;
  if (generations > 0) add_leaving(0, branches);
  for (std::size_t generation = 1; generation < generations; ++generation) {
    const std::size_t end = found.size();
    for (std::size_t i = first; i < end; ++i) {
      const std::vector<Branch> own = found[i].branches;
      add_leaving(i + 1, own);
    }
    first = end;
  }
  return found;
}

}  // namespace gearsweep
