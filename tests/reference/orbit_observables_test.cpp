// The reference engine's period, settling and kind of motion on sections whose answer is plain, and
// on the kernel's own.
#include "reference/detail/orbit_observables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "opencl/opencl_engine.hpp"
#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/zero_one_observable.hpp"
#include "reference/motion_classes.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AnyOf;
using ::testing::NanSensitiveDoubleEq;

constexpr double kTolerance = 1e-6;

using Sequence = std::function<double(std::size_t)>;

// Two states of one group.
const StateKinds kKinds = {{0, 0}, {}};

// A step of which only the end is looked at.
TrajectoryStep step_to(const Eigen::VectorXd& state) { return {.after = {state, {}}}; }

// What an observable says of sections whose first component is this sequence, the second half of
// it, and of perturbations that grow like this (as logarithms). Periods last one unit of time, in
// which the motion goes through a range of 1.
double measure(
    const std::unique_ptr<ReferenceObservable>& observable, const Window& window,
    const Sequence& section, const Sequence& growth = [](std::size_t) { return 0.0; }) {
  const auto state = [&](std::size_t i) { return Eigen::Vector2d(section(i), 0.5 * section(i)); };
  observable->begin(state(0));
  for (std::size_t i = 1; i <= window.record; ++i) {
    observable->step(step_to(state(i) + Eigen::Vector2d(0.25, 0.5)));
    observable->step(step_to(state(i) - Eigen::Vector2d(0.25, 0.5)));
    observable->period(state(i), Eigen::VectorXd::Constant(1, growth(i - 1)), 1.0);
  }
  return observable->finish(window).front();
}

double period_of(std::size_t record, const Sequence& section, double tolerance = kTolerance) {
  return measure(make_period(tolerance, kKinds), {.record = record}, section);
}

double settled_of(const Window& window, const Sequence& section) {
  return measure(make_settled(kTolerance, kKinds), window, section);
}

// Two states of which the second is far smaller than the first: its own range counts, unless both
// are of one group.
double period_beside_small(const std::vector<std::size_t>& groups, const Sequence& large,
                           const Sequence& small) {
  const auto period = make_period(kTolerance, StateKinds{groups, {}});
  const auto state = [&](std::size_t i) { return Eigen::Vector2d(large(i), 1e-9 * small(i)); };
  period->begin(state(0));
  for (std::size_t i = 1; i <= 200; ++i) {
    period->step(step_to(state(i) + Eigen::Vector2d(1.0, 1e-9)));
    period->period(state(i), Eigen::VectorXd(), 1.0);
  }
  return period->finish({.record = 200}).front();
}

// Never twice the same: multiples of the golden ratio, less their whole part.
double wander(std::size_t i) {
  const double turns = std::numbers::phi * static_cast<double>(i);
  return turns - std::floor(turns);
}

Sequence cycle(std::size_t period) {
  return [=](std::size_t i) { return wander(i % period); };
}

Sequence from_section(std::size_t first, const Sequence& later) {
  return [=](std::size_t i) { return i < first ? 2.0 + wander(i) : later(i); };
}

// A window of 64 periods up to a record of 383, of 128 from 384 on.
TEST(ReferencePeriod, IsFoundUpToHalfAWindow) {
  for (std::size_t period = 1; period <= 32; ++period) {
    EXPECT_EQ(period_of(383, cycle(period)), static_cast<double>(period));
  }
  EXPECT_EQ(period_of(383, cycle(33)), 0.0);
  EXPECT_EQ(period_of(384, cycle(33)), 33.0);
  EXPECT_EQ(period_of(384, cycle(64)), 64.0);
  EXPECT_EQ(period_of(384, cycle(65)), 0.0);
  EXPECT_EQ(period_of(384, wander), 0.0);
}

TEST(ReferencePeriod, IsThatOfEachStateInItsOwnRange) {
  EXPECT_EQ(period_beside_small({0, 1}, cycle(1), cycle(3)), 3.0);
  EXPECT_EQ(period_beside_small({0, 1}, cycle(2), cycle(3)), 6.0);
  EXPECT_EQ(period_beside_small({0, 1}, cycle(2), wander), 0.0);
  EXPECT_EQ(period_beside_small({0, 0}, cycle(2), wander), 2.0);  // what is of a group is noise
}

// 1e-7 more each period: within 1e-6 ten sections are the same and the eleventh is not, so nothing
// recurs; within 1e-3 the motion stands still.
TEST(ReferencePeriod, IsNotThatOfASlowDrift) {
  const Sequence drift = [](std::size_t i) { return 1.0 + 1e-7 * static_cast<double>(i); };
  EXPECT_EQ(period_of(200, drift), 0.0);
  EXPECT_EQ(period_of(200, drift, 1e-3), 1.0);
}

// Alternates about a cycle, nearer by this factor each time; a factor of 1 doubles the period.
Sequence alternating(std::size_t period, double first, double factor) {
  return [=](std::size_t i) {
    return cycle(period)(i) + first * std::pow(-factor, static_cast<double>(i / period));
  };
}

// It comes nearer to itself after two periods than after one; within 1e-6 only the former may be.
TEST(ReferencePeriod, IsNotTheDoubleOfAnApproachFromAlternatingSides) {
  for (const std::size_t period : {2U, 6U, 10U}) {
    std::size_t open = 0;
    for (double first = 1e-8; first < 1e-4; first *= 1.1) {
      const double found = period_of(200, alternating(period, first, 0.99));
      EXPECT_THAT(found, AnyOf(0.0, static_cast<double>(period))) << period << ' ' << first;
      open += found == 0.0 ? 1 : 0;
    }
    // From the first that is told down to 1e-8 all are.
    EXPECT_EQ(period_of(200, alternating(period, 1e-8, 0.99)), static_cast<double>(period));
    EXPECT_GT(open, 0U);
  }
}

// An orbit whose halves differ by a hundred times what is taken for the same has the longer period.
TEST(ReferencePeriod, IsTheDoubleWhereTheHalvesStayApart) {
  EXPECT_EQ(period_of(200, alternating(6, 1e-4, 1.0)), 12.0);
  EXPECT_EQ(period_of(200, alternating(2, 1e-4, 1.0)), 4.0);
}

// References are sections 63, 127, 191, ... What begins just after one is seen from the next on.
TEST(ReferencePeriod, LastsForAQuarterOfTheRecordToItsEnd) {
  EXPECT_EQ(period_of(170, from_section(127, cycle(5))), 5.0);  // 43 periods
  EXPECT_EQ(period_of(169, from_section(127, cycle(5))), 0.0);  // 42
  EXPECT_EQ(period_of(170, from_section(128, cycle(5))), 0.0);
  // All but the last multiple of 5 recur.
  const Sequence leaves = [](std::size_t i) { return i > 165 ? 2.0 : cycle(5)(i); };
  EXPECT_EQ(period_of(170, leaves), 0.0);
}

// From section 63 on the multiples of 32 are sections 95 and 127.
TEST(ReferencePeriod, RecursTwice) {
  EXPECT_EQ(period_of(127, from_section(63, cycle(32))), 32.0);
  EXPECT_EQ(period_of(126, from_section(63, cycle(32))), 0.0);
}

// The windows that begin at sections 0, 1, 3, 7, ... hold 1, 2, 4, 8, ... periods, and a period is
// seen in the first that holds it. Periods before the record count, too.
TEST(ReferenceSettled, IsTheReferenceFromWhichThePeriodHolds) {
  for (std::size_t period = 1; period <= 64; ++period) {
    EXPECT_EQ(settled_of({.before = 1000, .settle = 50, .record = 400}, cycle(period)),
              static_cast<double>(1050 + std::bit_ceil(period) - 1));
  }
  EXPECT_EQ(settled_of({.settle = 50, .record = 400}, from_section(100, cycle(3))), 50.0 + 127.0);
  EXPECT_EQ(settled_of({.settle = 50, .record = 400}, from_section(128, cycle(3))), 50.0 + 255.0);
  EXPECT_TRUE(std::isnan(settled_of({.settle = 50, .record = 400}, wander)));
}

double motion_of(const Window& window, const Sequence& section, const Sequence& growth) {
  return measure(make_motion(kTolerance, kKinds), window, section, growth);
}

// Grows by `total` over a record of 160; by 3 standard errors of 16 blocks, +-`error`.
Sequence grows(double total, double error = 0.0) {
  // Blocks of 10 that are alternately greater and less by a have a standard error of a/sqrt(15).
  const double a = error / (3.0 * 160.0) * std::sqrt(15.0);
  return [=](std::size_t i) { return total / 160.0 + (i / 10 % 2 == 0 ? a : -a); };
}

// The largest exponent of these log stretchings, and its error.
std::vector<double> exponent_of(const std::vector<double>& log_stretchings) {
  const auto exponent = make_lyapunov_max();
  for (const double one : log_stretchings) {
    exponent->period(Eigen::VectorXd(), Eigen::VectorXd::Constant(1, one), 1.0);
  }
  return exponent->finish({.record = log_stretchings.size()});
}

// Log stretchings whose exponent is known: what a vector's length varies by while it is carried
// round, by a wave of any length; a vector that turns from one direction into another; chaos, whose
// periods know nothing of each other. Of 1,000 of each, at most so many are off by more than three
// errors as a normal distribution has beyond three of its own.
TEST(ReferenceExponent, HasAnErrorToRelyOn) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  constexpr std::size_t kRecord = 200;
  using Lengths = std::function<double(double)>;  // the logarithm of the length at a time
  const auto count_beyond = [&](const std::function<std::pair<double, Lengths>()>& make) {
    std::size_t beyond = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto [truth, length] = make();
      std::vector<double> grown;
      for (std::size_t n = 0; n < kRecord; ++n) {
        grown.push_back(length(static_cast<double>(n + 1)) - length(static_cast<double>(n)));
      }
      const std::vector<double> found = exponent_of(grown);
      beyond += std::abs(found[0] - truth) > 3.0 * found[1] + 1e-12 ? 1 : 0;
    }
    return beyond;
  };
  const auto carried_round = [&]() -> std::pair<double, Lengths> {
    const double waves = std::exp(uniform(std::log(1.0), std::log(100.0)));
    const double size = uniform(0.01, 5.0), phase = uniform(0.0, 6.28);
    return {0.1, [=](double n) {
              return 0.1 * n + size * std::sin(phase + 2.0 * std::numbers::pi * waves * n /
                                                           static_cast<double>(kRecord));
            }};
  };
  const auto turns = [&]() -> std::pair<double, Lengths> {
    const double gap = std::exp(uniform(std::log(0.02), 0.0));
    const double first = std::exp(uniform(-2.0, 2.0));
    return {-0.05, [=](double n) {
              return -0.05 * n + 0.5 * std::log(1.0 + first * first * std::exp(-2.0 * gap * n));
            }};
  };
  const auto chaos = [&]() -> std::pair<double, Lengths> {
    std::vector<double> sums = {0.0};
    std::normal_distribution<double> one(0.1, 0.5);
    for (std::size_t n = 0; n < kRecord; ++n) sums.push_back(sums.back() + one(random));
    return {0.1, [=](double n) { return sums[static_cast<std::size_t>(n)]; }};
  };
  EXPECT_LE(count_beyond(carried_round), 3U);
  EXPECT_LE(count_beyond(turns), 3U);
  EXPECT_LE(count_beyond(chaos), 3U);
}

constexpr Window kLast = {.settle = 100, .record = 160, .is_last = true};
constexpr Window kNotLast = {.settle = 100, .record = 160, .is_last = false};

TEST(ReferenceMotion, FollowsFromAPeriodAndFromGrowth) {
  EXPECT_EQ(motion_of(kNotLast, cycle(3), grows(-5.0)), kPeriodic);
  EXPECT_EQ(motion_of(kNotLast, cycle(3), grows(5.0, 5.5)), kPeriodic);
  EXPECT_EQ(motion_of(kNotLast, cycle(3), grows(5.0, 4.5)), kUndecided);
  EXPECT_EQ(motion_of(kNotLast, wander, grows(5.0, 4.5)), kChaotic);
  EXPECT_EQ(motion_of(kNotLast, wander, grows(1.9)), kUndecided);
  EXPECT_EQ(motion_of(kNotLast, wander, grows(-20.0)), kUndecided);
}

TEST(ReferenceMotion, DecidesMoreInTheLastWindow) {
  EXPECT_EQ(motion_of(kLast, wander, grows(1.9, 2.0)), kQuasiPeriodic);
  EXPECT_EQ(motion_of(kLast, wander, grows(1.9, 1.8)), kUndecided);
  EXPECT_EQ(motion_of(kLast, wander, grows(-1.9, 1.8)), kUndecided);
  EXPECT_EQ(motion_of(kLast, wander, grows(0.009)), kQuasiPeriodic);
  EXPECT_EQ(motion_of(kLast, wander, grows(5.0, 5.5)), kQuasiPeriodic);
  EXPECT_EQ(motion_of(kLast, wander, grows(-5.0, 4.5)), kUndecided);
  EXPECT_EQ(motion_of(kLast, wander, grows(10.5, 11.0)), kUndecided);
}

// What decays goes to a periodic orbit, but a class that is periodic has a period.
TEST(ReferenceMotion, IsPeriodicOnlyWithAPeriod) {
  for (const double total : {-5.0, -20.0, -1000.0}) {
    EXPECT_EQ(motion_of(kLast, wander, grows(total)), kUndecided) << total;
  }
}

// Each section is 1.2 times as large as the one before: a motion without bounds, which grows.
TEST(ReferenceMotion, IsNotChaoticWhereItHasNoBounds) {
  const Sequence runaway = [](std::size_t i) { return std::pow(1.2, static_cast<double>(i)); };
  EXPECT_EQ(motion_of(kLast, runaway, grows(29.0)), kUndecided);
  EXPECT_EQ(motion_of(kLast, wander, grows(29.0)), kChaotic);
  // As slow a growth as that of the perturbation: of a linear motion.
  const Sequence linear = [](std::size_t i) { return std::exp(0.02 * static_cast<double>(i)); };
  EXPECT_EQ(motion_of(kLast, linear, grows(3.2)), kUndecided);
}

TEST(ReferenceMotion, IsQuasiPeriodicOnlyWhereTheSectionStaysAsLarge) {
  const auto widens = [](double factor) {
    return [=](std::size_t i) { return i > 80 ? factor * wander(i) : wander(i); };
  };
  EXPECT_EQ(motion_of(kLast, widens(1.2), grows(0.0)), kQuasiPeriodic);
  EXPECT_EQ(motion_of(kLast, widens(1.3), grows(0.0)), kUndecided);
  EXPECT_EQ(motion_of(kLast, widens(1.0 / 1.3), grows(0.0)), kUndecided);
  const Sequence drifts = [](std::size_t i) { return wander(i) + 0.1 * static_cast<double>(i); };
  EXPECT_EQ(motion_of(kLast, drifts, grows(0.0)), kUndecided);
  const Sequence nothing = [](std::size_t) { return 0.0; };
  EXPECT_EQ(motion_of({.settle = 100, .record = 1000, .is_last = false}, wander, nothing),
            kQuasiPeriodic);
  EXPECT_EQ(motion_of({.settle = 100, .record = 999, .is_last = false}, wander, nothing),
            kUndecided);
}

// Tells the observables of the motion that an engine's rows are: the start and the end of each
// step, in one segment a period. The kernel's range comes from one step in eight.
void show_rows(const std::vector<double>& rows, std::size_t steps,
               const std::vector<ReferenceObservable*>& observables) {
  const auto state = [&](std::size_t row) {
    return Eigen::Vector2d(rows[2 * row], rows[2 * row + 1]);
  };
  for (ReferenceObservable* observable : observables) {
    observable->begin(state(0));
    for (std::size_t first = 0; 2 * first < rows.size(); first += steps + 1) {
      for (std::size_t i = 0; i < steps; i += 8) observable->step(step_to(state(first + i + 1)));
      observable->period(state(first + steps), Eigen::VectorXd(), 1.0);
    }
  }
}

// The kernel's own sections, chaos and its end in a period included: what is said of the same
// sections does not depend on how trajectories part. The kernel takes the mean out of products of
// samples, where 1e-8 is left of them when a short transient is all that varies.
TEST(ReferenceOrbits, AreThoseOfTheKernelOnItsOwnSections) {
  constexpr Window kWindow = {.record = 1400};
  constexpr std::size_t kSteps = 64;
  const SweepResult kernel =
      run("[model]\nname = 'duffing'\npreset = 'two_well'\n[[axes]]\nname = 'amplitude'\n"
          "from = 0.1\nto = 0.6\ncount = 128\n[initial]\npolicy = 'fixed'\n"
          "state = {x = 0.2, v = 0.1}\n[integrate]\nsettle = 0\nrecord = 1400\n"
          "steps_per_period = 64\n[observe]\nquantities = ['period', 'settled', 'zero_one']\n");
  const Plan plan(kernel.study, kernel.study.points());
  const std::unique_ptr<Engine> engine = make_opencl_engine(kernel.study, std::nullopt);
  for (std::size_t point = 0; point < kernel.status.size(); ++point) {
    SCOPED_TRACE(kernel.study.axes[0].values[point]);
    const std::optional<std::vector<double>> rows =
        engine->rows(plan, point, {0.2, 0.1}, 0, kWindow.record, [](double) { return true; });
    const auto period = make_period(kTolerance, kKinds);
    const auto settled = make_settled(kTolerance, kKinds);
    const auto zero_one = make_zero_one(kTolerance, kKinds);
    show_rows(rows.value(), kSteps, {period.get(), settled.get(), zero_one.get()});
    EXPECT_EQ(period->finish(kWindow).front(), map_of(kernel, "period")[point]);
    EXPECT_THAT(settled->finish(kWindow).front(),
                NanSensitiveDoubleEq(map_of(kernel, "settled")[point]));
    EXPECT_NEAR(zero_one->finish(kWindow).front(), map_of(kernel, "zero_one")[point], 2e-7);
  }
}

}  // namespace
}  // namespace gearsweep::testing
