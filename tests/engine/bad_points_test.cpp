// A point that fails has a status and no values; its neighbours, in the lanes beside it too, have
// the bits that they have without it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bits.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// All numbers of a point: its maps, then its samples.
std::vector<double> numbers_of(const SweepResult& result, std::size_t point) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const std::size_t width = result.study.selection.quantities[i].width;
    const auto first = result.values[i].begin() + static_cast<std::ptrdiff_t>(point * width);
    numbers.insert(numbers.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  const std::size_t samples = result.samples.size() / result.status.size();
  const auto first = result.samples.begin() + static_cast<std::ptrdiff_t>(point * samples);
  numbers.insert(numbers.end(), first, first + static_cast<std::ptrdiff_t>(samples));
  return numbers;
}

void expect_same_point(const SweepResult& a, std::size_t point_a, const SweepResult& b,
                       std::size_t point_b) {
  EXPECT_EQ(a.status[point_a], STATUS_ok) << point_a;
  EXPECT_EQ(b.status[point_b], STATUS_ok) << point_b;
  const std::vector<double> left = numbers_of(a, point_a);
  const std::vector<double> right = numbers_of(b, point_b);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_TRUE(same_bits(left[i], right[i]))
        << "point " << point_a << ", number " << i << ": " << left[i] << " and " << right[i];
  }
}

void expect_no_values(const SweepResult& result, std::size_t point) {
  EXPECT_EQ(result.status[point], STATUS_diverged) << point;
  for (const double number : numbers_of(result, point)) EXPECT_TRUE(std::isnan(number)) << point;
}

// Good and bad values of the first axis, beside three of `omega`.
struct Mixture {
  std::string model;       // beginning of the study
  std::string quantities;  // beside those that every model has
  std::string axis;
  std::vector<std::string> values;
  std::vector<bool> are_good;
};

std::string list_of(const std::vector<std::string>& values) {
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + value;
  return "[" + list + "]";
}

// Steps of 0.05 are too long for bearings of this stiffness: the method is unstable beyond 2.8
// radians a step, and these take 11 and 50. The first grow by about 600 in each step, beyond the
// numbers of fp32 within a period, the second beyond those of fp64, too.
const Mixture kStiff = {"[model]\npreset = 'coarse'\n",
                        "'x1_rms', 'dmf_max', 'contact_class', 'contact_losses', ",
                        "k1",
                        {"0.9", "1.0", "1.38", "5e4", "1e6"},
                        {true, true, true, false, false}};
// What its own damping drives leaves the range at once, or while it settles, after some 100
// periods.
const Mixture kDriven = {"[model]\nname = 'duffing'\n[parameters]\nlinear = 1.0\ncubic = 0.0\n",
                         "'x_rms', ",
                         "damping",
                         {"-2.0", "-0.03", "0.1", "0.2", "0.3"},
                         {false, false, true, true, true}};

// A way to integrate, and the study's key that asks for it.
struct Way {
  std::string name, override;
};

class BadPointsTest : public ::testing::TestWithParam<Way> {
 protected:
  static SweepResult run_with(const Mixture& mixture, const std::vector<std::string>& values) {
    return run(mixture.model + "[[axes]]\nname = '" + mixture.axis +
                   "'\nvalues = " + list_of(values) +
                   "\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.65, 0.9]\n[integrate]\nsettle = "
                   "120\nrecord = 40\nwarm_up = 20\nextend = 4\n[observe]\nquantities = [" +
                   mixture.quantities +
                   "'period', 'settled', 'motion_class', 'lyapunov_max', 'section_min', "
                   "'poincare']\n",
               {GetParam().override});
  }

  static void expect_harmless(const Mixture& mixture) {
    std::vector<std::string> good;
    for (std::size_t i = 0; i < mixture.values.size(); ++i) {
      if (mixture.are_good[i]) good.push_back(mixture.values[i]);
    }
    const SweepResult mixed = run_with(mixture, mixture.values);
    const SweepResult alone = run_with(mixture, good);
    std::size_t point = 0, point_alone = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      for (const bool is_good : mixture.are_good) {
        if (is_good) {
          expect_same_point(mixed, point, alone, point_alone++);
        } else {
          expect_no_values(mixed, point);
        }
        ++point;
      }
    }
  }
};

TEST_P(BadPointsTest, StepsTooLongForTheStiffnessHarmOnlyTheirPoint) { expect_harmless(kStiff); }

TEST_P(BadPointsTest, MotionWithoutBoundsHarmsOnlyItsPoint) { expect_harmless(kDriven); }

INSTANTIATE_TEST_SUITE_P(Ways, BadPointsTest,
                         ::testing::Values(Way{"Orbit", "integrate.stop='orbit'"},
                                           Way{"Never", "integrate.stop='never'"},
                                           Way{"Fp32", "integrate.precision='fp32'"},
                                           Way{"Reference", "integrate.engine='reference'"}),
                         [](const auto& way) { return way.param.name; });

// Undamped and driven at its own frequency, an oscillator's amplitude grows by amplitude / 2 in
// each unit of time: to 8e5 at the end of the first record, 26 periods, and beyond 1e6 in the next.
TEST(BadPoints, APointThatFailsInALongerWindowHasNoValues) {
  const auto run_with = [](const std::string& amplitudes) {
    return run(
        "[model]\nname = 'duffing'\n[parameters]\nlinear = 1.0\ncubic = 0.0\ndamping = 0.0\n"
        "omega = 1.0\n[[axes]]\nname = 'amplitude'\nvalues = " +
        amplitudes +
        "\n[integrate]\nsettle = 10\nrecord = 16\nwarm_up = 2\nextend = 4\n"
        "[observe]\nquantities = ['x_rms', 'motion_class', 'poincare']\n");
  };
  const SweepResult mixed = run_with("[1.0, 100.0, 1e4]");
  const SweepResult alone = run_with("[1.0, 100.0]");
  expect_same_point(mixed, 0, alone, 0);
  expect_same_point(mixed, 1, alone, 1);
  expect_no_values(mixed, 2);
  const SweepResult short_one =
      run("[model]\nname = 'duffing'\n[parameters]\nlinear = 1.0\ncubic = "
          "0.0\ndamping = 0.0\nomega = 1.0\n[[axes]]\nname = 'amplitude'\n"
          "values = [1e4]\n[integrate]\nsettle = 10\nrecord = 16\n"
          "warm_up = 2\nextend = 1\n[observe]\nquantities = ['x_rms', "
          "'motion_class', 'poincare']\n");
  EXPECT_EQ(short_one.status[0], STATUS_ok);
}

// The successor of a bad point begins on its own, as the first of a chain does.
TEST(BadPoints, AChainGoesOnBehindABadPoint) {
  const auto run_with = [](const std::string& values, const std::string& policy) {
    return run("[model]\npreset = 'coarse'\n[[axes]]\nname = 'k1'\nvalues = " + values +
               "\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.65, 0.9]\n[initial]\npolicy = '" +
               policy + "'\nalong = 'k1'\n[integrate]\nsettle = 60\nrecord = 20\nstates = 'all'\n" +
               kObserveGear5);
  };
  // Ascending values stand with the bad ones at an end: forward they come last, backward first.
  const SweepResult whole = run_with("[1.0, 1.38, 5e4, 1e6]", "backward");
  const SweepResult alone = run_with("[1.0, 1.38]", "backward");
  for (std::size_t row = 0; row < 3; ++row) {
    expect_same_point(whole, 4 * row, alone, 2 * row);
    expect_same_point(whole, 4 * row + 1, alone, 2 * row + 1);
    expect_no_values(whole, 4 * row + 2);
    expect_no_values(whole, 4 * row + 3);
  }
  const SweepResult forward = run_with("[1.0, 1.38, 5e4]", "forward");
  const SweepResult forward_alone = run_with("[1.0, 1.38]", "forward");
  for (std::size_t row = 0; row < 3; ++row) {
    expect_same_point(forward, 3 * row + 1, forward_alone, 2 * row + 1);
    expect_no_values(forward, 3 * row + 2);
  }
}

}  // namespace
}  // namespace gearsweep::testing
