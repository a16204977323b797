// The reference engine's 0-1 test for chaos on series that its authors and others published.
#include "reference/detail/zero_one_observable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gearsweep::testing {
namespace {

// For a motion that goes through a range of 1 in each period, and is sampled so.
double zero_one_of(std::size_t record, const std::function<double(std::size_t)>& sample) {
  const std::unique_ptr<ReferenceObservable> observable = make_zero_one(1e-6, {{0, 1}, {}});
  observable->begin(Eigen::Vector2d(0.0, 7.0));
  for (std::size_t i = 0; i < record; ++i) {
    observable->step({.after = {Eigen::Vector2d(0.0, 7.0), {}}});
    observable->step({.after = {Eigen::Vector2d(1.0, 7.0), {}}});
    observable->period(Eigen::Vector2d(sample(i), 7.0), Eigen::VectorXd(), 1.0);
  }
  return observable->finish({.record = record}).front();
}

// x -> a x (1 - x), after 1000 steps.
std::function<double(std::size_t)> logistic_map(double a) {
  double x = 0.3;
  const auto step = [a](double at) { return a * at * (1.0 - at); };
  for (int i = 0; i < 1000; ++i) x = step(x);
  return [x, step](std::size_t) mutable { return x = step(x); };
}

// The examples of Gottwald and Melbourne (2009), with 2000 samples: period 8 at a = 3.55, chaos at
// 3.97; a = 4 has the largest exponent of all, ln 2. A regular walk stays bounded, so that K falls
// with the largest lag, 128 here; a tenth is what is left of it.
TEST(ReferenceZeroOne, TellsTheLogisticMapsChaosFromItsPeriods) {
  EXPECT_NEAR(zero_one_of(2000, logistic_map(3.55)), 0.0, 0.1);
  EXPECT_NEAR(zero_one_of(2000, logistic_map(3.97)), 1.0, 0.01);
  EXPECT_NEAR(zero_one_of(2000, logistic_map(4.0)), 1.0, 0.01);
}

TEST(ReferenceZeroOne, IsNearZeroForARotation) {
  const auto rotation = [](std::size_t i) {
    return std::cos(2.0 * M_PI * std::sqrt(2.0) * static_cast<double>(i));
  };
  EXPECT_NEAR(zero_one_of(2000, rotation), 0.0, 0.1);
}

// Neither shift nor scale of the series is of consequence: a thousand roundings of a mean that is
// a thousand times the series leave 1e-10.
TEST(ReferenceZeroOne, IsThatOfTheShiftedSeries) {
  auto plain = logistic_map(3.97);
  auto shifted = logistic_map(3.97);
  EXPECT_NEAR(zero_one_of(500, [&](std::size_t) { return 1000.0 - 3.0 * shifted(0); }),
              zero_one_of(500, plain), 1e-9);
}

// Within the tolerance, 1e-6 of the motion's range, the series stays at one value.
TEST(ReferenceZeroOne, IsZeroForASingleValue) {
  auto chaos = logistic_map(4.0);
  EXPECT_EQ(zero_one_of(200, [&](std::size_t i) { return 1.0 + 1e-6 * chaos(i); }), 0.0);
  EXPECT_GT(zero_one_of(200, [&](std::size_t i) { return 1.0 + 1e-5 * chaos(i); }), 0.9);
}

TEST(ReferenceZeroOne, NeedsAHundredPeriods) {
  EXPECT_TRUE(std::isnan(zero_one_of(99, logistic_map(4.0))));
  EXPECT_FALSE(std::isnan(zero_one_of(100, logistic_map(4.0))));
}

}  // namespace
}  // namespace gearsweep::testing
