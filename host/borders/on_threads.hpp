// Runs work that asks orbit maps on several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "borders/joined_orbit_map.hpp"

namespace gearsweep {

// Calls work(i) for all i below count. joined: the threads are members of it, and mostly wait for
// the device; null: as many threads as the host has cores. Throws what the first failure threw.
void for_each_on_threads(std::size_t count, JoinedOrbitMap* joined,
                         const std::function<void(std::size_t)>& work);

// The same of searches whose findings are taken one at a time in the order of their numbers, so
// that they do not depend on which thread is faster: take(i, find(i)).
template <typename Find, typename Take>
void for_each_in_order(std::size_t count, JoinedOrbitMap* joined, const Find& find,
                       const Take& take) {
  std::mutex mutex;
  std::vector<std::optional<decltype(find(std::size_t{0}))>> found(count);
  std::size_t next = 0;
  for_each_on_threads(count, joined, [&](std::size_t i) {
    auto own = find(i);
    const std::lock_guard lock(mutex);
    found[i] = std::move(own);
    for (; next < count && found[next]; ++next) {
      take(next, *std::exchange(found[next], std::nullopt));
    }
  });
}

}  // namespace gearsweep
