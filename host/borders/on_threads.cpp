#include "borders/on_threads.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace gearsweep {
namespace {

constexpr std::size_t kMembers = 8;  // which mostly wait for the device

}  // namespace

void for_each_on_threads(std::size_t count, JoinedOrbitMap* joined,
                         const std::function<void(std::size_t)>& work) {
  std::size_t next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    std::optional<JoinedOrbitMap::Member> member;
    if (joined != nullptr) member.emplace(joined);
    while (true) {
      std::size_t own = 0;
      {
        const std::lock_guard lock(mutex);
        if (next >= count || failure) return;
        own = next++;
      }
      try {
        work(own);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
      }
    }
  };
  const std::size_t most =
      joined != nullptr ? kMembers : std::max(1U, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(most, count); ++i) threads.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gearsweep
