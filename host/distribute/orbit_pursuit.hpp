// From guesses at periodic orbits to the orbits that the trajectories go to: Newton's method, the
// minimal period, and a look at whether each trajectory itself converges to its orbit. Private to
// this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "distribute/orbit_newton.hpp"
#include "engine/engine.hpp"

namespace gearsweep {

struct OrbitAttempt {
  std::size_t position = 0;  // of the point in the tile
  std::uint32_t length = 0;  // periods of the forcing after which the orbit comes back
  NewtonTry newton;
  NewtonVerdict verdict = NewtonVerdict::going_on;
  bool arrives = false;  // the trajectory goes to this orbit, whose length is the minimal period
  std::vector<double> derivative = {};  // [column][row], of the last step that came close
};

class OrbitPursuit {
 public:
  // The plan, the tile and the engine outlive the pursuit.
  OrbitPursuit(const Plan& plan, const Tile& tile, OrbitEngine* engine);

  // Attempts of one phase grid stand together. A trajectory is followed for so many periods at
  // most. False when the callback asked to stop.
  bool run(std::vector<OrbitAttempt>* attempts, std::size_t most_periods,
           const RoundCallback& after_round);

 private:
  using Attempts = std::vector<OrbitAttempt*>;

  std::optional<ReturnMaps> maps_of(const Attempts& attempts,
                                    const std::vector<std::uint32_t>& lengths,
                                    bool with_derivatives, const RoundCallback& after_round);
  // Each of these is false when the callback asked to stop.
  bool step(const Attempts& attempts, const RoundCallback& after_round);
  bool confirm(const Attempts& close, const RoundCallback& after_round);
  bool shorten(const Attempts& found, const RoundCallback& after_round);
  bool follow(Attempts found, std::size_t most_periods, const RoundCallback& after_round);
  bool sharpen(const Attempts& arriving, const RoundCallback& after_round);

  const Plan& plan_;
  const Tile& tile_;
  OrbitEngine* engine_;
  const NewtonLimits limits_;
  const std::size_t states_, tangents_;
};

}  // namespace gearsweep
