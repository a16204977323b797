// A point that stops on an orbit is where the run to the end goes, at random parameters of every
// periodically forced model and under its symmetries.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Each;

struct Range {
  const char* name;
  double low, high;
};

// A family of studies: two axes of random values, other parameters drawn once.
struct Family {
  const char* name;
  const char* model;         // the [model] table
  std::vector<Range> drawn;  // the last two are the axes
  const char* quantities;    // extremes
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

std::string study_of(const Family& family, std::mt19937* random, std::size_t values) {
  const auto draw = [&](const Range& range) {
    return std::uniform_real_distribution<double>(range.low, range.high)(*random);
  };
  std::string toml = fmt::format("[model]\n{}\n[parameters]\n", family.model);
  const std::size_t fixed = family.drawn.size() - 2;
  for (std::size_t i = 0; i < fixed; ++i) {
    toml += fmt::format("{} = {}\n", family.drawn[i].name, draw(family.drawn[i]));
  }
  for (std::size_t i = fixed; i < family.drawn.size(); ++i) {
    std::vector<double> axis;
    while (axis.size() < values) axis.push_back(draw(family.drawn[i]));
    std::sort(axis.begin(), axis.end());
    toml += fmt::format("[[axes]]\nname = '{}'\nvalues = [{}]\n", family.drawn[i].name,
                        fmt::join(axis, ", "));
  }
  return toml +
         fmt::format("[observe]\nquantities = [{}, 'period', 'settled']\n", family.quantities);
}

const char* const kForce = "'dmf_max', 'dmf_min', 'deflection_max', 'deflection_min'";
const char* const kState = "'x_max', 'x_min', 'v_max', 'v_min'";

class StoppedPoints : public ::testing::TestWithParam<Family> {};

// Both runs have the same bits until a point stops. After 2,500 periods what converges at all is
// where it goes to: multipliers of stopped points are below 0.99, which leaves a hundredth of the
// distance even of a period of 5, and they stop at a few thousandths.
TEST_P(StoppedPoints, AreWhereARunToTheEndGoes) {
  constexpr double kSettle = 400.0;
  std::mt19937 random(14);
  std::size_t stopped_points = 0;
  for (int draw = 0; draw < 2; ++draw) {
    const std::string study = study_of(GetParam(), &random, 8);
    const SweepResult stopped = run(study, {"integrate.settle=400", "integrate.record=240"});
    const SweepResult whole =
        run(study, {"integrate.stop=never", "integrate.settle=2500", "integrate.record=240"});
    for (std::size_t point = 0; point < stopped.status.size(); ++point) {
      if (!(map_of(stopped, "settled")[point] < kSettle)) continue;
      ++stopped_points;
      SCOPED_TRACE(fmt::format("{}\npoint {}", study, point));
      EXPECT_EQ(map_of(stopped, "period")[point], map_of(whole, "period")[point]);
      for (std::size_t i = 0; i < 4; ++i) {
        const double expected = whole.values[i][point];
        EXPECT_NEAR(stopped.values[i][point], expected, 1e-3 * (0.01 + std::abs(expected)))
            << whole.study.selection.quantities[i].name;
      }
    }
  }
  EXPECT_GT(stopped_points, 20U);
}

INSTANTIATE_TEST_SUITE_P(
    OfFamilies, StoppedPoints,
    ::testing::Values(
        Family{
            "GearLightLoad",
            "preset = 'consistent'",
            {{"zeta", 0.015, 0.03}, {"e0", 0.03, 0.06}, {"omega", 0.3, 1.6}, {"F1", 0.005, 0.06}},
            kForce},
        Family{"GearHeavyLoad",
               "preset = 'consistent'\nstiffness = 'rectangular'",
               {{"F1", 0.3, 3.0},
                {"zeta", 0.02, 0.06},
                {"mu", 0.0, 0.2},
                {"omega", 0.3, 1.8},
                {"e0", 0.1, 2.0}},
               kForce},
        Family{"GearLargeBacklash",
               "preset = 'coarse'",
               {{"zeta", 0.02, 0.05}, {"omega", 0.4, 2.0}, {"b", 1.0, 100.0}},
               kForce},
        Family{"GearDynamicBacklash",
               "preset = 'coarse'\nbacklash = 'dynamic'",
               {{"zeta", 0.03, 0.06}, {"omega", 0.4, 2.0}, {"b", 1.0, 3.0}},
               kForce},
        Family{"GearPrinted",
               "preset = 'paper'",
               {{"zeta", 0.06, 0.1}, {"omega", 0.2, 0.8}, {"b", 0.2, 1.2}},
               kForce},
        Family{"UnequalGears",
               "preset = 'consistent'",
               {{"teeth_ratio", 1.5, 4.0},
                {"m2", 0.1, 0.3},
                {"k2", 0.5, 1.0},
                {"omega", 0.3, 1.8},
                {"F1", 0.02, 0.3}},
               kForce},
        Family{"RigidShafts",
               "name = 'gear1'\npreset = 'spur'",
               {{"z", 0.015, 0.05}, {"Fte", 0.02, 0.08}, {"omega", 0.4, 2.2}, {"k", 0.02, 0.3}},
               kForce},
        Family{"RigidShaftsSquareWave",
               "name = 'gear1'\npreset = 'coarse'\nstiffness = 'square'",
               {{"z", 0.02, 0.06}, {"k", 0.1, 0.4}, {"omega", 0.4, 2.2}, {"Fm", 0.02, 0.4}},
               kForce},
        Family{"Pendulum",
               "name = 'pendulum'\npreset = 'sprott'",
               {{"damping", 0.04, 0.3}, {"drive", 0.2, 2.5}, {"omega", 0.3, 1.5}},
               "'v_max', 'v_min', 'energy_max', 'energy_min'"},
        Family{"TwoWells",
               "name = 'duffing'\npreset = 'two_well'",
               {{"damping", 0.1, 0.4}, {"amplitude", 0.05, 0.6}, {"omega", 0.4, 2.0}},
               kState},
        Family{"OneWell",
               "name = 'duffing'\npreset = 'ueda'",
               {{"damping", 0.04, 0.2}, {"amplitude", 1.0, 12.0}, {"omega", 0.5, 1.6}},
               kState},
        Family{"LockedLimitCycle",
               "name = 'vanderpol'\npreset = 'sprott'",
               {{"amplitude", 0.5, 8.0}, {"omega", 1.0, 3.0}},
               kState}),
    [](const auto& test) { return test.param.name; });

const std::string kLight =
    "[model]\npreset = 'consistent'\n[parameters]\nzeta = 0.02\n[[axes]]\nname = 'omega'\n"
    "from = 0.4\nto = 1.5\ncount = 12\n[[axes]]\nname = 'mu'\nvalues = [0.0, 0.05, 0.1]\n"
    "[observe]\nquantities = ['dmf_max', 'period', 'settled', 'contact_class', 'motion_class']\n";

// With constant backlash the equations are homogeneous in the lengths and forces: x, b, F1 and e0.
// Powers of two keep all digits.
TEST(StoppedPoints, AreTheSameInOtherUnits) {
  const SweepResult plain =
      run(kLight, {"parameters.b=1", "parameters.F1=0.05", "parameters.e0=0.125"});
  const SweepResult small = run(kLight, {"parameters.b=0.00390625", "parameters.F1=0.0001953125",
                                         "parameters.e0=0.00048828125"});
  EXPECT_GT(plain.stopped, 10U);
  EXPECT_EQ(small.stopped, plain.stopped);
  for (const char* name : {"period", "settled", "contact_class", "motion_class"}) {
    EXPECT_THAT(map_of(small, name),
                ::testing::Pointwise(::testing::NanSensitiveDoubleEq(), map_of(plain, name)))
        << name;
  }
  for (std::size_t point = 0; point < plain.status.size(); ++point) {
    EXPECT_EQ(256.0 * map_of(small, "dmf_max")[point], map_of(plain, "dmf_max")[point]);
  }
}

// Motion on one flank does not know b (model.md, exact test 4), however small it is beside it.
TEST(StoppedPoints, DoNotKnowTheBacklashOfMotionOnOneFlank) {
  const std::vector<std::string> load = {"parameters.F1=0.05", "parameters.e0=0.125"};
  const auto at = [&](double b) {
    return run(kLight, {load[0], load[1], fmt::format("parameters.b={}", b)});
  };
  const SweepResult near = at(1.0), far = at(300.0);
  std::size_t compared = 0;
  for (std::size_t point = 0; point < near.status.size(); ++point) {
    SCOPED_TRACE(point);
    if (map_of(near, "contact_class")[point] > 1.0 || map_of(near, "period")[point] == 0.0)
      continue;
    ++compared;
    for (const char* name : {"period", "contact_class", "motion_class"}) {
      EXPECT_EQ(map_of(far, name)[point], map_of(near, name)[point]) << name;
    }
    // 300 takes 9 bits from x1, which leaves it some 1e-13.
    EXPECT_NEAR(map_of(far, "dmf_max")[point], map_of(near, "dmf_max")[point], 1e-9);
  }
  EXPECT_GT(compared, 20U);
}

// x -> -x with the opposite drive is the same motion of the pendulum.
TEST(StoppedPoints, AreTheSameInAMirror) {
  const std::string pendulum =
      "[model]\nname = 'pendulum'\npreset = 'sprott'\n[parameters]\ndamping = 0.2\n"
      "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.4\ncount = 32\n"
      "[observe]\nquantities = ['v_max', 'v_min', 'period', 'settled']\n";
  const SweepResult one = run(pendulum, {"parameters.drive=1.2"});
  const SweepResult other = run(pendulum, {"parameters.drive=-1.2"});
  EXPECT_GT(one.stopped, 5U);
  EXPECT_EQ(one.stopped, other.stopped);
  EXPECT_EQ(map_of(one, "period"), map_of(other, "period"));
  for (std::size_t point = 0; point < one.status.size(); ++point) {
    EXPECT_EQ(map_of(one, "v_max")[point], -map_of(other, "v_min")[point]);
  }
}

// Once over the top in each period of the drive, this way or that: with full turns taken out the
// motion has a period, and its mean velocity is that of the drive. Where it goes over the top in no
// order, the 0-1 test says so.
TEST(StoppedPoints, KnowThePeriodOfARotation) {
  const std::string pendulum =
      "[model]\nname = 'pendulum'\npreset = 'cascade'\n[[axes]]\nname = 'drive'\n";
  const SweepResult rotation =
      run(pendulum +
          "values = [1.6, 1.7, 1.8, 1.98]\n"
          "[observe]\nquantities = ['period', 'v_mean', 'zero_one', 'x_max']\n");
  EXPECT_THAT(map_of(rotation, "period"), Each(1.0));
  EXPECT_THAT(map_of(rotation, "zero_one"), Each(0.0));
  EXPECT_EQ(rotation.stopped, rotation.status.size());
  for (const double velocity : map_of(rotation, "v_mean")) {
    // Newton's method leaves 1e-6 of the range of the angle over a period.
    EXPECT_NEAR(std::abs(velocity), 2.0 / 3.0, 1e-6);
  }
  const SweepResult chaos = run(pendulum +
                                "values = [2.04, 2.1]\n[integrate]\nrecord = 1000\n"
                                "[observe]\nquantities = ['zero_one', 'motion_class']\n");
  EXPECT_THAT(map_of(chaos, "motion_class"), Each(3.0));
  // Finite records leave a few hundredths.
  EXPECT_THAT(map_of(chaos, "zero_one"), Each(::testing::DoubleNear(1.0, 0.1)));
}

}  // namespace
}  // namespace gearsweep::testing
