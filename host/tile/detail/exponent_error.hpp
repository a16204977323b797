// The error of the largest Lyapunov exponent of periodic motion. Blocks of a record do not see it:
// they all have the same steps, and are as near to the orbit.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// Adds to the error of each periodic point of a finished tile how far its exponent is from that of
// the return map where it ended, and four times what steps of twice the length change there. Only
// of periods up to ORBIT_LONGEST. has_stopped: [point of the tile] its exponent is that of the
// return map. is_orbit: [point of the tile] it was recorded on its orbit, with the steps of
// orbit_plan. False when the callback asked to stop.
bool add_exponent_errors(const Plan& plan, const Plan& orbit_plan, const Tile& tile,
                         const std::vector<std::uint8_t>& has_stopped,
                         const std::vector<std::uint8_t>& is_orbit, OrbitEngine* engine,
                         const RoundCallback& after_round, TileResult* result);

}  // namespace gearsweep
