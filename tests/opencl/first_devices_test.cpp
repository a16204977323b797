// The first question for devices, which makes a driver prepare them. ctest gives this suite a
// process of its own.
#include <gtest/gtest.h>

#include <latch>
#include <thread>
#include <vector>

#include "opencl/device.hpp"

namespace gearsweep::testing {
namespace {

TEST(FirstDevices, AreTheSameForThreadsThatAskAtOnce) {
  constexpr std::size_t kThreads = 16;
  std::latch start(kThreads);
  std::vector<std::size_t> counts(kThreads);
  {
    std::vector<std::jthread> threads;
    for (std::size_t& count : counts) {
      threads.emplace_back([&] {
        start.arrive_and_wait();
        count = list_devices().size();
      });
    }
  }
  const std::vector<std::size_t> all(kThreads, list_devices().size());
  EXPECT_GT(all.front(), 0U);
  EXPECT_EQ(counts, all);
}

}  // namespace
}  // namespace gearsweep::testing
