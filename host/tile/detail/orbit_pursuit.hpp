// From guesses at periodic orbits to orbits: Newton's method and the minimal period.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/engine.hpp"
#include "tile/detail/orbit_newton.hpp"

namespace gearsweep {

struct OrbitAttempt {
  std::size_t position = 0;  // of the point in the tile
  std::uint32_t length = 0;  // periods of the forcing after which the orbit comes back
  NewtonTry newton;
  NewtonVerdict verdict = NewtonVerdict::going_on;
  std::vector<double> derivative = {};  // [column][row], of the last step that came close
};

class OrbitPursuit {
 public:
  // The plan, the tile and the engine outlive the pursuit. An orbit is not farther than `far` from
  // where a trajectory nearly comes back, in ranges of the motion. kept: as of NewtonLimits.
  OrbitPursuit(const Plan& plan, const Tile& tile, OrbitEngine* engine, double far, double kept);

  // Attempts of one phase grid stand together. Each of these is false when the callback asked to
  // stop.
  using Attempts = std::vector<OrbitAttempt*>;

  // Those whose verdict is `found` then are on a stable orbit, whose length is the minimal period.
  bool find(const Attempts& attempts, const RoundCallback& after_round);

  // Takes the multipliers of attempts that were found, where exponents need them, at the orbit
  // itself and not at a state that is near it by more than what counts as the same. Those with
  // which that fails are no longer found.
  bool sharpen(Attempts found, const RoundCallback& after_round);

 private:
  std::optional<ReturnMaps> maps_of(const Attempts& attempts, const RoundCallback& after_round);
  // Each of these is false when the callback asked to stop.
  bool step(const Attempts& attempts, const RoundCallback& after_round);
  bool confirm(const Attempts& close, const RoundCallback& after_round);

  const Plan& plan_;
  const Tile& tile_;
  OrbitEngine* engine_;
  const NewtonLimits limits_;
  const std::size_t states_, tangents_;
};

}  // namespace gearsweep
