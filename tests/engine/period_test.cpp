// Period, settling and kind of motion against orbits that are known, and against the section's own
// samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/bits.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// Values of motion_class.
constexpr double kUndecided = 0.0, kPeriodic = 1.0, kQuasiPeriodic = 2.0, kChaotic = 3.0;

// gear5 at some mesh frequencies. All tests ask for the same quantities, so that there are few
// programs to build.
std::string sweep(const std::string& preset, const std::string& omegas) {
  return "[model]\npreset = '" + preset + "'\n[[axes]]\nname = 'omega'\nvalues = [" + omegas +
         "]\n" + kObserveMotionOfGear5;
}

// Distance of two recorded sections, by the largest component, relative to the largest of all.
class Sections {
 public:
  Sections(const SweepResult& result, std::size_t point) {
    for (std::size_t state = 0; state < result.study.selection.poincare.size(); ++state) {
      states_.push_back(samples_of(result, point, state));
      for (const double value : states_.back()) scale_ = std::max(scale_, std::abs(value));
    }
  }
  std::size_t count() const { return states_[0].size(); }
  double distance(std::size_t i, std::size_t j) const {
    double max = 0.0;
    for (const auto& state : states_) max = std::max(max, std::abs(state[i] - state[j]));
    return max / scale_;
  }

 private:
  std::vector<std::vector<double>> states_;
  double scale_ = 0.0;
};

// The first is in the table of reference numbers that independent programs agree on, with period 1;
// so is the last, with period 3.
TEST(Period, IsThatOfTheReferenceOrbits) {
  for (const std::string precision : {"fp64", "fp32"}) {
    SCOPED_TRACE(precision);
    const SweepResult result =
        run(sweep("consistent", "0.7, 1.0, 1.2"), {"integrate.precision=" + precision});
    EXPECT_EQ(map_of(result, "period"), (std::vector<double>{1.0, 1.0, 3.0}));
    // 400 periods of settling are more than enough here.
    for (const double settled : map_of(result, "settled")) EXPECT_LT(settled, 400.0 + 16.0);
  }
}

// What the kernel says of an orbit holds for its samples: they recur after the period, and after no
// smaller number of periods. The kernel compares each with a reference at one phase of the orbit;
// at others the same deviation may be some times larger, hence ten times the tolerance.
TEST(Period, IsTheLeastThatTheSectionRecursAfter) {
  const SweepResult result =
      run(sweep("coarse", "0.65, 0.8, 1.0, 1.205, 1.4, 1.7, 1.9"), {"integrate.record=2000"});
  EXPECT_EQ(map_of(result, "period"), (std::vector<double>{1.0, 1.0, 1.0, 6.0, 0.0, 8.0, 2.0}));
  for (std::size_t point = 0; point < 7; ++point) {
    SCOPED_TRACE(result.study.axes[0].values[point]);
    const auto period = static_cast<std::size_t>(map_of(result, "period")[point]);
    const Sections sections(result, point);
    if (period == 0) {
      EXPECT_TRUE(std::isnan(map_of(result, "settled")[point]));
      // The motion is not periodic: the last section has no double in the 500 before it.
      for (std::size_t lag = 1; lag <= 500; ++lag) {
        EXPECT_GT(sections.distance(1999, 1999 - lag), 1e-6) << lag;
      }
      continue;
    }
    const auto settled = static_cast<std::size_t>(map_of(result, "settled")[point]) - 400;
    for (std::size_t i = settled; i + period < sections.count(); ++i) {
      ASSERT_LE(sections.distance(i, i + period), 1e-5) << i;
    }
    for (std::size_t lag = 1; lag < period; ++lag) {
      EXPECT_GT(sections.distance(1999, 1999 - lag), 1e-6) << lag;
    }
  }
}

// A linear oscillator goes to an orbit of period 1. With a natural frequency of p/q of the forcing
// it does so from q sides in turn, and comes nearest to itself after q periods. These decay to the
// tolerance within some record or other: the damping is chosen to do so after 1,000 to 4,000.
TEST(Period, IsNotThatOfAnApproachThatAlternatesOrTurns) {
  const std::string study =
      "[model]\nname = 'duffing'\n[parameters]\ncubic = 0.0\namplitude = 1.0\n"
      "[[axes]]\nname = 'linear'\nvalues = [0.0625, 0.1111111111, 0.25, 0.4444444444, "
      "0.6944444444, 1.5625, 1.96, 2.25]\n"
      "[[axes]]\nname = 'damping'\nfrom = 0.001\nto = 0.01\ncount = 64\n"
      "[initial]\npolicy = 'fixed'\nstate = {x = 0.1, v = 1.0}\n"
      "[integrate]\nmax_step = 0.1\nsettle = 1000\nrecord = 100\nstop = 'never'\n"
      "[observe]\nquantities = ['period']\n";
  for (const std::string extend : {"1", "16"}) {
    SCOPED_TRACE(extend);
    const SweepResult result = run(study, {"integrate.extend=" + extend});
    const std::vector<double>& period = map_of(result, "period");
    const auto ones = std::count(period.begin(), period.end(), 1.0);
    const auto open = std::count(period.begin(), period.end(), 0.0);
    EXPECT_EQ(ones + open, 512);
    EXPECT_GE(ones, 256);
  }
}

// From the start, without settling: the transient is not taken for the motion, and `settled` tells
// how long it took. References lie at most 512 periods apart in a record of this length, so the
// orbit may have settled up to so many periods before.
// A mass beside the motion has come to rest, away from 0: its speed is rounding of its place, which
// comes back by chance. A clock that a reset moves is neutral, and its growth rounding.
TEST(Period, IsNotThatOfRounding) {
  constexpr const char* kBeside = R"toml([model]
text = """
[model]
name = "beside"
[states]
x = {}
v = {}
y = { start = "0.1" }
w = {}
c = {}
[parameters]
omega = 1.0
[equations]
x = "v"
v = "cos(phase) - 0.05*v - x"
y = "w"
w = "-1.25*(y - 0.3) - 0.125*w"
c = "1"
[forcing]
period = "2*pi/omega"
[surfaces.tick]
when = "c - 0.2*pi/omega"
reset = { c = "c - 0.2*pi/omega" }
"""
[[axes]]
name = "omega"
from = 1.7
to = 2.3
count = 48
[integrate]
settle = 400
record = 66
stop = "never"
[observe]
quantities = ["period", "motion_class"]
)toml";
  const SweepResult result = run(kBeside);
  EXPECT_THAT(map_of(result, "period"), ::testing::Each(1.0));
  EXPECT_THAT(map_of(result, "motion_class"), ::testing::Each(kPeriodic));
}

TEST(Settled, TellsHowLongASlowTransientTook) {
  const SweepResult result =
      run(sweep("coarse", "0.8, 1.9"), {"integrate.settle=0", "integrate.record=1600"});
  EXPECT_EQ(map_of(result, "period"), (std::vector<double>{1.0, 2.0}));
  for (std::size_t point = 0; point < 2; ++point) {
    SCOPED_TRACE(result.study.axes[0].values[point]);
    const Sections sections(result, point);
    const auto period = static_cast<std::size_t>(map_of(result, "period")[point]);
    // The first section that is as the last of its phase within the tolerance.
    std::size_t first = sections.count() - 1;
    while (first > 0 &&
           sections.distance(first - 1,
                             sections.count() - 1 - (sections.count() - first) % period) <= 1e-6) {
      --first;
    }
    const double settled = map_of(result, "settled")[point];
    EXPECT_GT(settled, 20.0);
    EXPECT_NEAR(settled, static_cast<double>(first), 512.0);
  }
}

// At omega 1.9 a mode decays by exp(-0.0157) each period: after 400 it is still 2e-3 of what it
// was, and the 200 that are recorded do not suffice.
TEST(Motion, CallsASlowTransientUndecidedWhenItMayNotGoOn) {
  const SweepResult result =
      run(sweep("coarse", "1.9"), {"integrate.extend=1", "integrate.stop=never"});
  EXPECT_EQ(map_of(result, "period")[0], 0.0);
  EXPECT_EQ(map_of(result, "motion_class")[0], kUndecided);
}

// By default such a point goes on until its period shows, unless it stops on its orbit before. What
// is not a verdict on the motion stays as the study's own window had it, to the last bit.
TEST(Motion, GoesOnUntilASlowTransientHasSettled) {
  const std::string study = sweep("coarse", "1.9");
  const std::string exhaustive = "integrate.stop=never";
  const SweepResult result = run(study, {exhaustive});
  EXPECT_EQ(map_of(result, "period")[0], 2.0);
  EXPECT_EQ(map_of(result, "motion_class")[0], kPeriodic);
  // exp(-0.0157 n) is 1e-6 of the first deviation, of size 1, after some 880 periods.
  EXPECT_GT(map_of(result, "settled")[0], 600.0);
  EXPECT_LT(map_of(result, "settled")[0], 2000.0);
  const SweepResult single = run(study, {exhaustive, "integrate.extend=1"});
  EXPECT_EQ(map_of(result, "x1_rms"), map_of(single, "x1_rms"));
  EXPECT_EQ(map_of(result, "dmf_max"), map_of(single, "dmf_max"));
  EXPECT_EQ(result.samples, single.samples);
}

TEST(Motion, TellsPeriodicQuasiPeriodicAndChaotic) {
  const SweepResult result =
      run(sweep("coarse", "0.55, 0.65, 1.1, 1.4, 1.5, 1.7"), {"integrate.record=2000"});
  EXPECT_EQ(map_of(result, "motion_class"),
            (std::vector<double>{kChaotic, kPeriodic, kQuasiPeriodic, kChaotic, kQuasiPeriodic,
                                 kPeriodic}));
}

// What grows without bounds, drifts or is still on its way is no motion of a class: a linear
// oscillator of negative damping, a body under a constant force with friction alone, and a slow
// relaxation at exactly the rate a. Parameters turn one model into each of them, so that the device
// compiles once.
TEST(Motion, WithoutBoundsOrOnItsWayIsUndecided) {
  const auto classes_of = [](const std::string& parameters, const std::string& a) {
    const SweepResult result = run(
        "[model]\ntext = '''\n[model]\nname = 'open'\nmax_step = 0.1\n[states]\nx = {}\ny = {}\n"
        "[parameters]\na = 1.0\nslow = 0.0\npush = 0.0\nnegative = 0.0\nstiffness = 0.0\n"
        "friction = 0.0\nshift = 0.0\n[equations]\nx = '(1 - slow)*y + slow*a*(y^2 - x)'\n"
        "y = 'sin(phase + shift) + negative*a*y + push*a + 2*slow - stiffness*x - friction*y'\n"
        "[forcing]\nperiod = '2*pi/1.3'\n'''\n[parameters]\n" +
        parameters + "[[axes]]\nname = 'a'\nvalues = " + a +
        "\n[observe]\nquantities = ['motion_class']\n");
    return map_of(result, "motion_class");
  };
  // x' = y, y' = a y - x + sin(phase)
  for (const double found :
       classes_of("negative = 1.0\nstiffness = 1.0\n", "[0.0005, 0.001, 0.002, 0.01]")) {
    EXPECT_EQ(found, kUndecided);
  }
  // x' = y, y' = a + sin(phase) - 0.1 y
  for (const double found : classes_of("push = 1.0\nfriction = 0.1\n", "[0.01, 0.1, 1.0]")) {
    EXPECT_EQ(found, kUndecided);
  }
  // x' = a (y^2 - x), y' = -y + 2 + cos(phase)
  for (const double found : classes_of("slow = 1.0\nfriction = 1.0\nshift = 1.5707963267948966\n",
                                       "[3e-6, 1e-5, 3e-5]")) {
    EXPECT_EQ(found, kUndecided);
  }
}

// On the ridge between two wells at rest the state recurs exactly, yet what is beside it leaves by
// exp(0.883 t), 0.883 being the positive root of s^2 + 0.25 s - 1.
TEST(Motion, CallsAContradictionUndecided) {
  const SweepResult result =
      run("[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\namplitude = 0\n"
          "[[axes]]\nname = 'omega'\nvalues = [1.0]\n[observe]\n"
          "quantities = ['motion_class', 'period', 'lyapunov_max']\n");
  EXPECT_GT(map_of(result, "lyapunov_max")[0], 0.8);
  EXPECT_EQ(map_of(result, "period")[0], 1.0);
  EXPECT_EQ(map_of(result, "motion_class")[0], kUndecided);
}

const std::string kMap =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.9\ncount = 9\n"
    "[[axes]]\nname = 'b'\nfrom = 0.3\nto = 1.3\ncount = 7\n" +
    kObserveMotionOfGear5;

// The classes rest on what the study's other maps say, each computed on its own.
TEST(Motion, AgreesWithPeriodAndExponent) {
  const SweepResult result = run(kMap);
  std::vector<std::size_t> seen(4, 0);
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const double period = map_of(result, "period")[point];
    const double exponent = map_of(result, "lyapunov_max")[point];
    const double error = 3.0 * map_of(result, "lyapunov_max_error")[point];
    const double motion = map_of(result, "motion_class")[point];
    ++seen[static_cast<std::size_t>(motion)];
    if (motion == kPeriodic) {
      EXPECT_GT(period, 0.0);
      // 2/(200 T) at the largest omega, where a period T is smallest.
      EXPECT_LE(exponent, std::max(error, 0.01 * 1.9 / (2.0 * M_PI)));
    } else if (motion != kUndecided) {
      EXPECT_EQ(period, 0.0);
    }
    if (motion == kChaotic) {
      EXPECT_GT(exponent, error);
    }
    if (motion == kQuasiPeriodic) {
      // exp(2) in 1000 periods, again at the largest omega.
      EXPECT_LE(std::abs(exponent), std::max(error, 0.002 * 1.9 / (2.0 * M_PI)));
    }
  }
  EXPECT_LE(seen[0], 1U);
  for (std::size_t motion = 1; motion < seen.size(); ++motion) EXPECT_GT(seen[motion], 0U);
}

// The first has one lane, the others the device's own. How the search for orbits is cut up is for
// OrbitSearch.IsTheSameForAnyCut.
TEST(Period, HasTheSameBitsHoweverTheWorkIsCut) {
  const std::string study = kMap + "[integrate]\nrecord = 70\nstop = 'never'\n";
  const SweepResult expected = run(study, {"integrate.lanes=1"});
  for (const std::string cut :
       {"integrate.tile=10", "integrate.round=1", "integrate.round=7", "integrate.round=1000"}) {
    SCOPED_TRACE(cut);
    const SweepResult result = run(study, {cut});
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U) << i;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
