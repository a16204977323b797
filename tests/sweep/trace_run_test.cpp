// Traces pass through the maps, and between the steps through what is known exactly.
#include "sweep/trace_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

Trace trace_of_study(const std::string& toml, std::size_t samples_per_period = 0) {
  return *run_trace(read_study(toml, "test.toml"), samples_per_period, {});
}

const std::vector<double>& channel(const Trace& trace, const std::string& name) {
  const auto found =
      std::find_if(trace.channels.begin(), trace.channels.end(),
                   [&](const ChannelInfo& candidate) { return candidate.name == name; });
  if (found == trace.channels.end()) throw std::logic_error("the trace has no " + name);
  return trace.values[static_cast<std::size_t>(found - trace.channels.begin())];
}

// By the trapezoidal rule; a break phase stands twice in tau and adds nothing.
double time_average(const Trace& trace, const std::function<double(std::size_t)>& value) {
  double sum = 0.0;
  for (std::size_t i = 1; i < trace.tau.size(); ++i) {
    sum += 0.5 * (trace.tau[i] - trace.tau[i - 1]) * (value(i) + value(i - 1));
  }
  return sum / trace.tau.back();
}

// Values at phase 0, after each whole period.
std::vector<double> section(const Trace& trace, const std::string& name) {
  std::vector<double> out;
  double next = trace.period;
  for (std::size_t i = 0; i < trace.tau.size(); ++i) {
    if (trace.tau[i] < next - 1e-9) continue;
    out.push_back(channel(trace, name)[i]);
    next += trace.period;
  }
  return out;
}

std::string gear_point(const std::string& omega, const std::string& integrate) {
  return "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [" + omega +
         "]\n[integrate]\nrecord = 12\n" + integrate + kObserveGear5;
}

// The flanks that touch, as the maps have them: the moments of a wedged tooth, too.
TEST(Trace, TellsWhichFlanksTouch) {
  const std::string toml =
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nb = 0.1\n[[axes]]\n"
      "name = 'omega'\nvalues = [0.5021]\n[integrate]\nsettle = 60\nrecord = 4\n"
      "steps_per_period = 4096\n" +
      kObserveGear5;
  const SweepResult map = run(toml);
  ASSERT_GT(map_of(map, "contact_wedged")[0], 0.01);
  const Trace trace = trace_of_study(toml);
  const std::vector<double>& contact = channel(trace, "contact");
  const auto fraction = [&](double flank) {
    return time_average(trace, [&](std::size_t i) { return contact[i] == flank ? 1.0 : 0.0; });
  };
  // A step's worth at each of a dozen changes in a period.
  EXPECT_NEAR(fraction(1.0), map_of(map, "contact_drive")[0], 3e-3);
  EXPECT_NEAR(fraction(0.0), map_of(map, "contact_gap")[0], 3e-3);
  EXPECT_NEAR(fraction(-1.0), map_of(map, "contact_back")[0], 3e-3);
  EXPECT_NEAR(fraction(2.0), map_of(map, "contact_wedged")[0], 3e-3);
}

// A point in chaos, one on an orbit that stops early, one that runs to the end; both engines.
TEST(Trace, GivesTheMapsOfItsPoint) {
  for (const std::string& toml :
       {gear_point("0.55", ""), gear_point("0.8", ""), gear_point("0.8", "stop = 'never'\n"),
        gear_point("1.0", "engine = 'reference'\nsettle = 30\n")}) {
    SCOPED_TRACE(toml);
    const SweepResult map = run(toml);
    const Trace trace = trace_of_study(toml);
    const std::vector<double>& x1 = channel(trace, "x1");
    const std::vector<double>& dmf = channel(trace, "dmf");
    constexpr double kRounding = 1e-12;
    // The trace has the steps' ends; the map looks inside the steps. Averages over the ends are off
    // by 1.2e-6 here, extremes by 3.3e-4; no end lies beyond the map's extremes.
    constexpr double kAverage = 1e-5;
    constexpr double kExtreme = 1e-3;
    EXPECT_NEAR(time_average(trace, [&](std::size_t i) { return x1[i]; }),
                map_of(map, "x1_mean")[0], kAverage);
    EXPECT_NEAR(std::sqrt(time_average(trace, [&](std::size_t i) { return x1[i] * x1[i]; })),
                map_of(map, "x1_rms")[0], kAverage);
    for (const auto& [name, values] : {std::pair{"x1", x1}, std::pair{"dmf", dmf}}) {
      const auto [min, max] = std::minmax_element(values.begin(), values.end());
      EXPECT_NEAR(*min, map_of(map, name + std::string("_min"))[0], kExtreme);
      EXPECT_NEAR(*max, map_of(map, name + std::string("_max"))[0], kExtreme);
      EXPECT_GE(*min, map_of(map, name + std::string("_min"))[0] - kRounding);
      EXPECT_LE(*max, map_of(map, name + std::string("_max"))[0] + kRounding);
    }
    // Within a step of each change of flank.
    const std::vector<double>& contact = channel(trace, "contact");
    EXPECT_NEAR(time_average(trace, [&](std::size_t i) { return contact[i] == 1.0 ? 1.0 : 0.0; }),
                map_of(map, "contact_drive")[0], 0.02);
    const std::vector<double> x1_section = section(trace, "x1");
    const std::vector<double> v3_section = section(trace, "v3");
    ASSERT_EQ(x1_section.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_NEAR(x1_section[i], samples_of(map, 0, 0)[i], kRounding);
      EXPECT_NEAR(v3_section[i], samples_of(map, 0, 7)[i], kRounding);
    }
  }
}

// In chaos, and on an orbit whose map repeats one turn. Without passive states a compiler may round
// differently.
TEST(Trace, PassesThroughTheSamplesBitForBit) {
  for (const char* omega : {"0.55", "0.8"}) {
    SCOPED_TRACE(omega);
    const std::string toml = gear_point(omega, "states = 'all'\n");
    const SweepResult map = run(toml);
    EXPECT_EQ(map.stopped, std::string(omega) == "0.8" ? 1U : 0U);
    EXPECT_EQ(section(trace_of_study(toml), "x1"), samples_of(map, 0, 0));
  }
}

// The last point of a chain of three, as the whole map has it.
TEST(Trace, FollowsAChainToItsPoint) {
  const std::string chain =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.50, 0.52, 0.55]\n"
      "[initial]\npolicy = 'forward'\nalong = 'omega'\n"
      "[integrate]\nsettle = 40\nrecord = 5\nstop = 'never'\n" +
      kObserveGear5;
  EXPECT_EQ(section(trace_of_study(chain), "x1"), samples_of(run(chain), 2, 0));
}

// x'' + x = 0 from x = 1 is cos(tau): Hermite's cubic between steps of h leaves h^4/384, the method
// h^4/120 in each unit of time.
TEST(Trace, InterpolatesBetweenSteps) {
  const Trace trace = trace_of_study(
      "[model]\nname = 'duffing'\n[parameters]\ndamping = 0\nlinear = 1\ncubic = 0\namplitude = 0\n"
      "[[axes]]\nname = 'omega'\nvalues = [0.7]\n[initial]\npolicy = 'fixed'\nstate = {x = 1.0}\n"
      "[integrate]\nsettle = 0\nrecord = 3\nsteps_per_period = 200\n",
      77);
  ASSERT_EQ(trace.tau.size(), 3U * 77U);
  const double h = 2.0 * std::numbers::pi / 0.7 / 200.0;
  for (std::size_t i = 0; i < trace.tau.size(); ++i) {
    EXPECT_NEAR(trace.tau[i], static_cast<double>(i) * trace.period / 77.0, 1e-12);
    EXPECT_NEAR(channel(trace, "x")[i], std::cos(trace.tau[i]),
                std::pow(h, 4) * (1.0 / 384.0 + trace.tau[i] / 120.0));
    // The signal is worked out from the state: energy (v^2 + x^2)/2 is conserved.
    EXPECT_NEAR(channel(trace, "energy")[i], 0.5, 1e-6);
  }
}

// mu (C f + 2 zeta H D') pushes the shafts apart along the sliding direction, and nothing slides
// without friction.
TEST(Trace, ShowsFrictionOnlyWhereThereIsSome) {
  const std::string study = gear_point("0.8", "");
  const Trace with = trace_of_study(study);
  const Trace without = *run_trace(read_study(study, "test.toml", {"parameters.mu=0"}), 0, {});
  EXPECT_GT(*std::max_element(channel(with, "friction").begin(), channel(with, "friction").end()),
            1e-4);
  for (const double force : channel(without, "friction")) EXPECT_EQ(force, 0.0);
  for (const double force : channel(without, "friction_lever")) EXPECT_EQ(force, 0.0);
}

// x'' + x = cos(omega t), with a wall at x = 0 that the velocity leaves with 0.8 of itself.
constexpr const char* kImpacts =
    "[model]\nname = 'hard_impact'\n[parameters]\nr = 0.8\n[[axes]]\nname = 'omega'\n"
    "values = [2.8]\n[integrate]\nsettle = 100\nrecord = 12\n[observe]\n"
    "quantities = ['wall_impacts', 'v_max']\n";

TEST(Trace, HasTheValuesBeforeAndBehindAnImpact) {
  const Trace trace = trace_of_study(kImpacts);
  const std::vector<double>&event = channel(trace, kEvents), &x = channel(trace, "x"),
        &v = channel(trace, "v");
  std::size_t impacts = 0;
  for (std::size_t i = 0; i < event.size(); ++i) {
    if (event[i] == 0.0) continue;
    EXPECT_EQ(event[i], 1.0);
    EXPECT_NEAR(x[i], 0.0, 1e-9);
    ++impacts;
    ASSERT_LT(i + 1, event.size());
    EXPECT_EQ(trace.tau[i + 1], trace.tau[i]);
    EXPECT_EQ(event[i + 1], 1.0);
    EXPECT_GT(v[i], 0.0);
    EXPECT_NEAR(v[i + 1], -0.8 * v[i], 1e-9);
    ++i;
  }
  const SweepResult map = run(kImpacts);
  EXPECT_DOUBLE_EQ(static_cast<double>(impacts) / 12.0, map_of(map, "wall_impacts")[0]);
}

TEST(Trace, EvenMomentsTellThatThereWasAnImpact) {
  constexpr std::size_t kSamples = 256;
  const Trace trace = trace_of_study(kImpacts, kSamples), exact = trace_of_study(kImpacts);
  EXPECT_EQ(trace.tau.size(), 12 * kSamples);
  const auto impacts_in = [](const Trace& one) {
    return std::ranges::count(channel(one, kEvents), 1.0);
  };
  EXPECT_EQ(2 * impacts_in(trace), impacts_in(exact));
}

// A body that does not rebound leaves a table a cos(t) before its top, where a cos(t) = g.
TEST(Trace, TellsWhereABodyLeavesATableThatItRestsOn) {
  const Trace trace = trace_of_study(R"toml([model]
text = """
[model]
name = "table"
[states]
x = { start = "a" }
v = {}
[parameters]
a = 1.1
[equations]
x = "v"
v = "-1"
[forcing]
period = "2*pi"
[surfaces.ground]
when = "a*cos(phase) - x"
reset = { v = "-a*sin(phase)" }
"""
[[axes]]
name = "a"
values = [1.1]
[integrate]
settle = 5
record = 1
stop = "never"
max_step = 0.05
[observe]
quantities = ["x_max"]
)toml");
  const std::vector<double>&event = channel(trace, kEvents), &v = channel(trace, "v");
  std::vector<double> left;
  for (std::size_t i = 0; i + 1 < event.size(); ++i) {
    if (event[i] == 1.0 && event[i + 1] == 1.0 && v[i] == v[i + 1]) left.push_back(trace.tau[i]);
  }
  ASSERT_EQ(left.size(), 1U);
  EXPECT_NEAR(std::remainder(left[0], 2.0 * std::numbers::pi), -std::acos(1.0 / 1.1), 1e-6);
}

// It sticks to the belt from one jump of the friction's sign to the next.
TEST(Trace, TellsWhereItBeginsAndEndsToStick) {
  const Trace trace = trace_of_study(
      "[model]\nname = 'stribeck'\n[[axes]]\nname = 'belt'\nvalues = [0.2]\n[integrate]\n"
      "settle = 20\nrecord = 4\n[observe]\nquantities = ['v_max']\n");
  EXPECT_TRUE(trace.is_clockless);
  const std::vector<double>&event = channel(trace, kEvents), &v = channel(trace, "v");
  std::size_t events = 0;
  for (std::size_t i = 0; i < event.size(); ++i) {
    if (event[i] == 0.0) continue;
    EXPECT_EQ(event[i], -1.0);  // nothing is reset
    EXPECT_NEAR(v[i], 0.2, 1e-9);
    ++events;
  }
  EXPECT_GE(events, 2U * 2U * 3U);  // two of a cycle, each with both moments
}

}  // namespace
}  // namespace gearsweep::testing
