// The orbit that a settled motion is on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "orbits/shooting.hpp"

namespace gearsweep {

// The largest period that is looked for by itself.
inline constexpr std::size_t kLongestPeriod = 64;

// The periodic orbit that a settled trajectory is on: looks for the smallest period of at most
// kLongestPeriod at which the state returns, then shoots. With `period`, shoots from where the
// trajectory comes closest to repeating itself after that many periods, so that an unstable orbit
// inside chaos can be found. Throws RunError that says what to try when there is no such orbit.
Orbit find_orbit(const PeriodMap& map, const Eigen::VectorXd& settled,
                 std::optional<std::size_t> period);

// The same of a motion that nothing drives. It is looked at where it returns (orbits/returns.hpp),
// and `period` counts returns; `step`: what it is integrated with till then, in dimensionless time.
// A cycle takes `steps` from a return to the next, or more where `step` asks for that.
struct CycleSearch {
  double step = 0.0;
  std::size_t steps = 0;
  std::optional<std::size_t> period;
};
Orbit find_cycle(const PeriodMap& map, const Eigen::VectorXd& settled, const CycleSearch& search);

// The same cycle from that of its moments that is farthest from all surfaces, each in units of what
// its level reaches. A cycle that is followed must not begin on one: its neighbours would begin on
// either side, and what carries them round has another derivative there. Others are given back.
Orbit away_from_surfaces(const PeriodMap& map, const Orbit& cycle);

// The equilibrium that a motion has come to: a stable one, of the way to which a ten thousandth is
// left, or less. Nothing where the motion goes on.
std::optional<Orbit> find_rest(const PeriodMap& map, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& settled);

}  // namespace gearsweep
