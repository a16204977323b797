// How far two runs are from each other, by maps that are written here.
#include "sweep/detail/map_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "study/builtin_models.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Tolerances kTolerances = {.maps = 1e-3, .exponents = 1e-3};

// 200 points, the first 100 of them on orbits: x1_rms rises from 0 to 199, contact_class is 1.
SweepResult ramp(double scale = 1.0, double offset = 0.0) {
  SweepResult result;
  result.study.model = find_model("gear5");
  result.study.selection = select_quantities(*result.study.model, {"x1_rms", "contact_class"}, {});
  result.values.resize(2);
  for (int i = 0; i < 200; ++i) {
    result.status.push_back(0);
    result.on_orbit.push_back(i < 100 ? 1 : 0);
    result.values[0].push_back(scale * i + offset);
    result.values[1].push_back(1.0);
  }
  return result;
}

TEST(MapErrors, AreSharesOfTheRangeAtPeriodicPoints) {
  const SweepResult fine = ramp();
  SweepResult coarse = fine;
  coarse.values[0][3] += 2.0;
  coarse.values[0][150] += 50.0;  // not periodic
  const MapErrors errors(coarse, fine, kTolerances);
  EXPECT_EQ(errors.points(), 100U);
  EXPECT_EQ(errors.largest(0.01), 0.0);               // one of a hundred may be off
  EXPECT_NEAR(errors.largest(0.0), 2.0 / 196, 1e-3);  // of 98 % of the range
}

TEST(MapErrors, KnowNeitherUnitsNorOffset) {
  const auto largest = [](double scale, double offset) {
    const SweepResult fine = ramp(scale, offset);
    SweepResult coarse = fine;
    for (double& value : coarse.values[0]) value += 0.5 * scale;
    return MapErrors(coarse, fine, kTolerances).largest(0.01);
  };
  EXPECT_NEAR(largest(1e-6, 0.0), largest(1.0, 0.0), 1e-12);
  EXPECT_NEAR(largest(-1.0, 1e6), largest(1.0, 0.0), 1e-9);
}

// As of a fixed point, where nothing varies but by rounding.
TEST(MapErrors, OfAConstantMapAreSharesOfItsSize) {
  SweepResult fine = ramp();
  for (std::size_t i = 0; i < 200; ++i) {
    fine.values[0][i] = 0.5 * (1.0 + 2e-16 * static_cast<double>(i % 5));
  }
  SweepResult coarse = fine;
  for (double& value : coarse.values[0]) value *= 1.0 + 1e-13;
  EXPECT_LT(MapErrors(coarse, fine, kTolerances).largest(0.0), 1e-12);
}

// A map of a state is judged by what that ranges over in the motion, if that is larger.
TEST(MapErrors, OfAMapThatHardlyVariesAreSharesOfTheMotion) {
  const SweepResult fine = ramp(1e-5, 7.0);
  SweepResult coarse = fine;
  for (double& value : coarse.values[0]) value += 1e-5;
  EXPECT_NEAR(MapErrors(coarse, fine, kTolerances, {{"x1", 0.5}}).largest(0.0), 2e-5, 1e-9);
  EXPECT_GT(MapErrors(coarse, fine, kTolerances).largest(0.0), 4e-3);
}

// Nothing good can be said of a step that makes a point diverge.
TEST(MapErrors, CountAPointThatDivergesInOneRun) {
  SweepResult fine = ramp();
  const SweepResult coarse = fine;
  fine.status[3] = 1;
  fine.on_orbit[3] = 0;
  for (std::vector<double>& map : fine.values) map[3] = kNaN;
  const MapErrors errors(coarse, fine, kTolerances);
  EXPECT_EQ(errors.points(), 100U);
  EXPECT_EQ(errors.beyond(), 1U);
  EXPECT_EQ(errors.beyond_in_any(), 1U);
}

TEST(MapErrors, OfAClassAreAllOrNothing) {
  const SweepResult fine = ramp();
  SweepResult coarse = fine;
  coarse.values[1][0] = coarse.values[1][1] = 2.0;
  const MapErrors errors(coarse, fine, kTolerances);
  EXPECT_EQ(errors.of_quantities(0.01),
            (std::map<std::string, double>{{"x1_rms", 0.0}, {"contact_class", 1.0}}));
}

TEST(MapErrors, TakeAMissingNumberForWrongAndTwoForTheSame) {
  SweepResult fine = ramp();
  SweepResult coarse = fine;
  coarse.values[0][0] = fine.values[0][0] = kNaN;
  EXPECT_EQ(MapErrors(coarse, fine, kTolerances).largest(0.0), 0.0);
  coarse.values[0][1] = kNaN;
  EXPECT_TRUE(std::isinf(MapErrors(coarse, fine, kTolerances).largest(0.0)));
}

// Chaos scatters; a bias shows through it.
TEST(MapErrors, CompareMeansWhereTheMotionIsNotPeriodic) {
  const SweepResult fine = ramp();
  SweepResult scattered = fine, biased = fine;
  for (std::size_t i = 100; i < 200; ++i) {
    scattered.values[0][i] += i % 2 == 0 ? 20.0 : -20.0;
    biased.values[0][i] += i % 2 == 0 ? 22.0 : -2.0;
  }
  EXPECT_TRUE(MapErrors(scattered, fine, kTolerances).others_agree(0.01));
  EXPECT_FALSE(MapErrors(biased, fine, kTolerances).others_agree(0.01));
  EXPECT_TRUE(MapErrors(biased, fine, {0.1, 0.1}).others_agree(0.01));
}

// Steps that are too long diverge, at points that are not periodic, too.
TEST(MapErrors, CountTheOtherPointsThatOneRunHasAlone) {
  const SweepResult fine = ramp();
  SweepResult coarse = fine;
  coarse.values[0][150] = kNaN;
  EXPECT_TRUE(MapErrors(coarse, fine, kTolerances).others_agree(0.01));
  coarse.values[0][151] = kNaN;
  EXPECT_FALSE(MapErrors(coarse, fine, kTolerances).others_agree(0.01));
}

// 100 points on orbits: x1_rms is off by 2e-3 of its range, lyapunov_max and kaplan_yorke by 5e-3.
MapErrors errors_with_exponents(double exponents) {
  SweepResult fine;
  fine.study.model = find_model("gear5");
  fine.study.selection =
      select_quantities(*fine.study.model, {"x1_rms", "lyapunov_max", "kaplan_yorke"}, {});
  fine.values.resize(3);
  for (int i = 0; i < 100; ++i) {
    fine.status.push_back(0);
    fine.on_orbit.push_back(1);
    for (std::vector<double>& map : fine.values) map.push_back(i);
  }
  SweepResult coarse = fine;
  for (double& value : coarse.values[0]) value += 2e-3 * 97.0;
  for (double& value : coarse.values[1]) value += 5e-3 * 97.0;
  for (double& value : coarse.values[2]) value += 5e-3 * 97.0;
  return {coarse, fine, {.maps = 3e-3, .exponents = exponents}};
}

TEST(MapErrors, OfExponentsHaveATolerance) {
  EXPECT_TRUE(errors_with_exponents(1e-2).furthest(0.01).is_kept());
  EXPECT_EQ(errors_with_exponents(1e-2).furthest(0.01).quantity, "x1_rms");
  const FurthestMap exponent = errors_with_exponents(3e-3).furthest(0.01);
  EXPECT_FALSE(exponent.is_kept());
  EXPECT_TRUE(exponent.is_exponent);
  EXPECT_NEAR(exponent.error, 5e-3, 2e-4);
  // In its own terms: it may be as far off as it likes.
  EXPECT_NEAR(errors_with_exponents(0.1).largest(0.01), 5e-3, 2e-4);
}

// Between runs whose step is halved each time: by pair, the errors that the first points have. The
// others have none.
double sensitive_share(const std::vector<std::vector<double>>& pairs, double scale = 1.0,
                       double offset = 0.0) {
  const SweepResult fine = ramp(scale, offset);
  const double range = 196.0 * scale;  // of 98 % of the points
  std::vector<MapErrors> halvings;
  for (const std::vector<double>& errors : pairs) {
    SweepResult coarse = fine;
    for (std::size_t i = 0; i < errors.size(); ++i) coarse.values[0][i] += errors[i] * range;
    halvings.emplace_back(coarse, fine, kTolerances);
  }
  return MapErrors::sensitive_share(halvings);
}

// Two points that land elsewhere by chance, one that has done so for the first time, and one that
// does now and then, but not in the last pair.
TEST(SensitiveShare, CountsPointsThatNoShorterStepBringsNearer) {
  const std::vector<std::vector<double>> pairs = {
      {0.4, 0.1, 0.0, 0.3}, {0.0, 0.2, 0.0, 0.3}, {0.4, 0.15, 0.2, 0.0}};
  EXPECT_EQ(sensitive_share(pairs), 0.03);
  EXPECT_EQ(sensitive_share(pairs, -1e-6, 1.0), 0.03);
}

// Errors of first order, with a factor of up to three that depends on where in a step the kinks
// lie; and of fourth order. All are still beyond the tolerance.
TEST(SensitiveShare, LeavesOutPointsThatConvergeSlowly) {
  EXPECT_EQ(sensitive_share(
                {{0.08, 0.06, 0.08, 0.4}, {0.04, 0.01, 0.08, 0.03}, {0.02, 0.03, 0.02, 0.002}}),
            0.0);
}

// Where long steps diverge, their error tells no more than one of the whole range.
TEST(SensitiveShare, TakesAMissingNumberForAnErrorOfTheRange) {
  EXPECT_EQ(sensitive_share({{kNaN, kNaN}, {0.0, 0.0}, {0.6, 0.4}}), 0.01);
}

TEST(SensitiveShare, IsZeroWhereAllIsWithinTheTolerance) {
  EXPECT_EQ(sensitive_share({{0.0}, {5e-4}, {9e-4}}), 0.0);
}

}  // namespace
}  // namespace gearsweep::testing
