// What `reproduce` reads out of maps and traces, on ones whose answers are plain.
#include "reproduce/detail/measured.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gearsweep {
namespace {

// 24 periods of 3 + 0.25 sin(2 pi t/T) + 0.01 cos(2 pi t/(3 T)), on uneven moments, one of them
// twice.
Trace wave() {
  Trace trace;
  trace.period = 1.7;
  trace.channels = {{"x1", "1", "a wave"}};
  trace.values.resize(1);
  const auto add = [&](double periods) {
    const double angle = 2.0 * std::numbers::pi * periods;
    trace.tau.push_back(periods * trace.period);
    trace.values[0].push_back(3.0 + 0.25 * std::sin(angle) + 0.01 * std::cos(angle / 3.0));
  };
  for (int i = 0; i <= 24 * 400; ++i) {
    const double share = i / 400.0;
    add(share + 2e-4 * std::sin(20.0 * std::numbers::pi * share));
    if (i == 1234) add(trace.tau.back() / trace.period);
  }
  return trace;
}

// The trapezoidal rule leaves (2 pi/400)^2/12 = 2e-5 of a wave.
TEST(Amplitude, IsThatOfTheWaveAtItsOrder) {
  const Trace trace = wave();
  EXPECT_NEAR(amplitude_at(trace, "x1", 1.0), 0.25, 1e-4 * 0.25);
  EXPECT_NEAR(amplitude_at(trace, "x1", 1.0 / 3.0), 0.01, 1e-4 * 0.25);
  EXPECT_NEAR(amplitude_at(trace, "x1", 2.0), 0.0, 1e-4 * 0.25);
}

TEST(Range, IsFromTheLeastToTheGreatest) {
  const auto [min, max] = range_of(wave(), "x1");
  EXPECT_NEAR(min, 2.74, 0.01);
  EXPECT_NEAR(max, 3.26, 0.01);
}

TEST(MapCurve, FindsItsWayAlongTheAxis) {
  SweepResult result;
  result.study = read_study(
      "[[axes]]\nname = 'omega'\nvalues = [0.1, 0.2, 0.3, 0.4]\n[observe]\n"
      "quantities = ['x1_rms', 'dmf_max']\n",
      "test");
  result.values = {{1.0, 4.0, 2.0, 9.0}, {0.0, 0.0, 0.0, 0.0}};
  const MapCurve curve(result, "x1_rms");
  EXPECT_EQ(curve.within(0.15, 0.35), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(curve.max_in(0.15, 0.35), 1U);
  EXPECT_EQ(curve.nearest(0.31), 2U);
  EXPECT_EQ(share_of(curve.within(0.0, 1.0), [&](std::size_t i) { return curve[i] > 3.0; }), 0.5);
  EXPECT_EQ(share_of({}, [](std::size_t) { return true; }), 0.0);
}

}  // namespace
}  // namespace gearsweep
