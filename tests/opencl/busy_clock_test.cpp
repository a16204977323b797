#include "opencl/busy_clock.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace gearsweep {
namespace {

using std::chrono::steady_clock;

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

TEST(BusyClock, CountsLaunchesThatOverlapOnce) {
  BusyClock clock;
  const auto start = steady_clock::now();
  double inner = 0.0;
  const double outer = clock.time([&] { inner = clock.time(wait_a_little); });
  EXPECT_LE(clock.seconds(), seconds_since(start));
  EXPECT_GE(clock.seconds(), outer);
  EXPECT_GE(outer, inner);
  EXPECT_GE(inner, 0.002);
}

TEST(BusyClock, StandsBetweenLaunchesAndRunsDuringThem) {
  BusyClock clock;
  clock.time(wait_a_little);
  const double before = clock.seconds();
  wait_a_little();
  EXPECT_EQ(clock.seconds(), before);
  clock.time([&] {
    wait_a_little();
    EXPECT_GE(clock.seconds(), before + 0.002);
  });
}

TEST(BusyClock, EndsALaunchThatFails) {
  BusyClock clock;
  EXPECT_THROW(clock.time([] { throw std::runtime_error("lost"); }), std::runtime_error);
  const double before = clock.seconds();
  wait_a_little();
  EXPECT_EQ(clock.seconds(), before);
}

}  // namespace
}  // namespace gearsweep
