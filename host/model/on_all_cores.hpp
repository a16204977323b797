// A loop whose turns are independent, on all cores of the host.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace gearsweep {

// Calls work(i) for all i below `count`, in any order, several at once. `work` does not throw.
template <class Work>
void for_each_on_all_cores(std::size_t count, const Work& work) {
  constexpr std::size_t kShare = 32;
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t first = next.fetch_add(kShare); first < count;
         first = next.fetch_add(kShare)) {
      for (std::size_t i = first; i < std::min(count, first + kShare); ++i) work(i);
    }
  };
  const std::size_t useful = std::min<std::size_t>(
      (count + kShare - 1) / kShare, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < useful; ++i) threads.emplace_back(run);
  run();
}

}  // namespace gearsweep
