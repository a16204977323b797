// Breaks that were found before.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

namespace gearsweep {

// By what decides where they are, to the bit; threads share it. A study's plan, the estimates of
// its memory and its tables ask for the same breaks, and points differ in much that decides none.
class BreakMemory {
 public:
  // find: is called for what is new, and may throw.
  template <class Find>
  std::vector<double> breaks(const std::vector<double>& deciding, const Find& find) {
    std::vector<std::uint64_t> key;
    key.reserve(deciding.size());
    for (const double number : deciding) key.push_back(std::bit_cast<std::uint64_t>(number));
    {
      const std::lock_guard lock(mutex_);
      const auto known = known_.find(key);
      if (known != known_.end()) return known->second;
    }
    std::vector<double> found = find();
    const std::lock_guard lock(mutex_);
    if (known_.size() >= kMost) known_.clear();
    known_.emplace(std::move(key), found);
    return found;
  }

 private:
  static constexpr std::size_t kMost = 16384;  // some MB

  std::mutex mutex_;
  std::map<std::vector<std::uint64_t>, std::vector<double>> known_;
};

}  // namespace gearsweep
