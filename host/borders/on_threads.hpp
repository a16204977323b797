// Runs work that asks orbit maps on several threads.
#pragma once

#include <cstddef>
#include <functional>

#include "borders/joined_orbit_map.hpp"

namespace gearsweep {

// Calls work(i) for all i below count. joined: the threads are members of it, and mostly wait for
// the device; null: as many threads as the host has cores. Throws what the first failure threw.
void for_each_on_threads(std::size_t count, JoinedOrbitMap* joined,
                         const std::function<void(std::size_t)>& work);

}  // namespace gearsweep
