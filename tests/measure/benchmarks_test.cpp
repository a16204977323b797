// Which benchmarks a device gets, and how one is carried out. How long anything takes is not
// tested.
#include "measure/benchmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

constexpr double kNoLimit = 1e9;

DeviceInfo some_device(bool fp64) {
  DeviceInfo device;
  device.fp64 = fp64;
  device.lanes_fp64 = 8;
  device.lanes_fp32 = 16;
  return device;
}

std::vector<Benchmark> of_device(bool fp64, const std::atomic<bool>* stop) {
  return benchmarks_of(some_device(fp64), {0, 0.01, "/nonexistent", stop});
}

std::vector<std::string> names_of(const std::vector<Benchmark>& benchmarks) {
  std::vector<std::string> names;
  for (const Benchmark& one : benchmarks) names.push_back(one.name);
  return names;
}

// Takes a second, as it says.
Benchmark counting(int* prepared, int* repeated) {
  return {"some/thing", {"step", "steps/s", 1e6}, "", [=] {
            ++*prepared;
            return PreparedBenchmark{"-DOPTION", [=] {
                                       ++*repeated;
                                       return Repetition{100.0 * *repeated, 1.0, 2.0, {}};
                                     }};
          }};
}

TEST(Benchmarks, AreThoseOfTheDevice) {
  const std::atomic<bool> stop = false;
  const std::vector<Benchmark> all = of_device(true, &stop);
  std::vector<std::string> names = names_of(all);
  EXPECT_THAT(names, IsSupersetOf({"fma/fp64", "fma/fp32", "settle/fp64", "settle/fp64/lanes:1",
                                   "settle/fp64/lanes:16", "settle/fp32/lanes:1",
                                   "record/fp64/six_maps", "record/fp32/lyapunov_max",
                                   "record/fp32/lyapunov_spectrum", "map/fp64/stop:orbit",
                                   "map/fp64/stop:never", "start/cold", "start/warm"}));
  // What suits the device has no number of lanes.
  EXPECT_THAT(names, Not(Contains("settle/fp64/lanes:8")));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  for (const Benchmark& one : all) EXPECT_EQ(one.obstacle, "") << one.name;
}

TEST(Benchmarks, WithoutFp64AreSkippedWithTheReason) {
  const std::atomic<bool> stop = false;
  for (const Benchmark& one : of_device(false, &stop)) {
    const bool needs_fp64 = one.name.find("fp64") != std::string::npos;
    EXPECT_EQ(one.obstacle, needs_fp64 ? "the device has no fp64" : "") << one.name;
    if (!needs_fp64) continue;
    const BenchmarkRow measured = carry_out(one, 3, kNoLimit, stop);
    EXPECT_EQ(measured.reason, one.obstacle);
    EXPECT_FALSE(measured.failed);
    EXPECT_THAT(measured.repetitions, IsEmpty());
  }
  EXPECT_THAT(names_of(of_device(false, &stop)), Contains("map/fp32/stop:never"));
}

TEST(Benchmarks, TryLanesAroundThoseThatSuit) {
  EXPECT_THAT(lanes_to_try(some_device(true), true), ElementsAre(1, 8, 16));
  EXPECT_THAT(lanes_to_try(some_device(true), false), ElementsAre(1, 16));
}

TEST(CarryOut, PreparesOnceAndRepeats) {
  const std::atomic<bool> stop = false;
  int prepared = 0, repeated = 0;
  const BenchmarkRow measured = carry_out(counting(&prepared, &repeated), 3, kNoLimit, stop);
  EXPECT_EQ(prepared, 1);
  EXPECT_EQ(measured.build_options, "-DOPTION");
  EXPECT_THAT(measured.rates(), ElementsAre(100.0, 200.0, 300.0));
}

TEST(CarryOut, BeginsNoRepetitionAfterItsTime) {
  const std::atomic<bool> stop = false;
  int prepared = 0, repeated = 0;
  EXPECT_EQ(carry_out(counting(&prepared, &repeated), 9, 1.5, stop).repetitions.size(), 2U);
}

TEST(CarryOut, StopsWhenItIsTold) {
  const std::atomic<bool> stop = true;
  int prepared = 0, repeated = 0;
  EXPECT_THAT(carry_out(counting(&prepared, &repeated), 9, kNoLimit, stop).repetitions, IsEmpty());
}

TEST(CarryOut, AFailureLeavesItsReason) {
  const std::atomic<bool> stop = false;
  const Benchmark fails = {
      "some/thing", {}, "", []() -> PreparedBenchmark { throw RunError("no luck"); }};
  const BenchmarkRow measured = carry_out(fails, 3, kNoLimit, stop);
  EXPECT_TRUE(measured.failed);
  EXPECT_EQ(measured.reason, "no luck");
}

// On the default device, next to no time for each.
TEST(Benchmarks, OfKernelsWork) {
  const std::atomic<bool> stop = false;
  const std::vector<DeviceInfo> devices = list_devices();
  const std::size_t number = default_device(devices);
  for (const Benchmark& one : benchmarks_of(devices[number], {number, 1e-6, "", &stop})) {
    if (one.name != "fma/fp32" && one.name != "settle/fp32") continue;
    const BenchmarkRow measured = carry_out(one, 2, kNoLimit, stop);
    EXPECT_EQ(measured.reason, "") << one.name;
    ASSERT_EQ(measured.repetitions.size(), 2U) << one.name;
    for (const double rate : measured.rates()) EXPECT_GT(rate, 0.0) << one.name;
  }
}

}  // namespace
}  // namespace gearsweep::testing
