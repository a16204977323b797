// Impacts on the flanks of a contact: counts, speed and depth, against motions whose solution is
// known and the reference engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

// All tests ask for the same, so that there are few programs to build.
const std::string kImpacts =
    "[observe]\nquantities = ['contact_impacts_drive', 'contact_impacts_back', "
    "'contact_impacts_speed', 'contact_impacts_depth', 'contact_losses', 'dmf_min', 'dmf_max']\n";

double impact_value(const SweepResult& result, const std::string& what, std::size_t point = 0) {
  return map_of(result, "contact_impacts_" + what)[point];
}

// gear1 without damping, load and error, stiffness 1: between the flanks x flies at speed 1, and on
// a flank it is half a wave x = b + sin t. So a whole motion takes 2 pi + 4 b, and has an impact on
// each flank with speed 1 and depth 1. `periods` of the recorded length 2 pi/omega.
std::string free_flight(double b, double omega, int record, double max_step) {
  return "[model]\nname = 'gear1'\n[parameters]\nz = 0.0\nFm = 0.0\nFte = 0.0\nFte_2 = 0.0\n"
         "Fte_3 = 0.0\nk = 0.0\nk_2 = 0.0\nk_3 = 0.0\nomega = " +
         digits(omega) + "\n[[axes]]\nname = 'b'\nvalues = [" + digits(b) +
         "]\n[initial]\npolicy = 'fixed'\nstate = {x = 0.1, v = 1.0}\n[integrate]\nsettle = 0\n"
         "record = " +
         std::to_string(record) + "\nstop = 'never'\nmax_step = " + digits(max_step) + "\n" +
         kImpacts;
}

TEST(Impacts, OfAFreeFlightBetweenTheFlanksAreCountedAndMeasured) {
  const double b = 0.7;
  const double motion = 2.0 * std::numbers::pi + 4.0 * b;
  const SweepResult result = run(free_flight(b, 2.0 * std::numbers::pi / motion, 5, 0.02));
  EXPECT_EQ(impact_value(result, "drive"), 1.0);
  EXPECT_EQ(impact_value(result, "back"), 1.0);
  EXPECT_NEAR(impact_value(result, "speed"), 1.0, 1e-4);
  EXPECT_NEAR(impact_value(result, "depth"), 1.0, 1e-7);
  // Each contact begins with an impact, so the largest force on either flank follows one.
  EXPECT_NEAR(map_of(result, "dmf_max")[0], 1.0, 1e-7);
  EXPECT_NEAR(map_of(result, "dmf_min")[0], -1.0, 1e-7);
}

// No impact without a loss: never more than one apart in a record, and none in steady contact. The
// numbers of a motion are whole in a whole period of it.
TEST(Impacts, AreAsManyAsLossesInAPeriodicMotion) {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.25, 0.65, 0.8, 1.0]\n"
          "[integrate]\nsettle = 400\nrecord = 12\n" +
          replaced(kImpacts, "'dmf_max'", "'dmf_max', 'period'"));
  bool any = false;
  for (std::size_t point = 0; point < 4; ++point) {
    const double period = map_of(result, "period")[point];
    if (period == 0.0) continue;
    const double drive = impact_value(result, "drive", point);
    const double back = impact_value(result, "back", point);
    EXPECT_NEAR(drive + back, map_of(result, "contact_losses")[point], 1e-12);
    EXPECT_NEAR(drive * period, std::round(drive * period), 1e-12);
    EXPECT_EQ(impact_value(result, "speed", point) > 0.0, drive + back > 0.0);
    EXPECT_EQ(impact_value(result, "depth", point) > 0.0, drive + back > 0.0);
    any = any || drive > 0.0;
  }
  EXPECT_TRUE(any);
}

const std::string kOneWave =
    "[model]\nname = 'gear1'\n[parameters]\nFte_2 = 0.0\nFte_3 = 0.0\nk = 0.0\nk_2 = 0.0\n"
    "k_3 = 0.0\nomega = 0.9\n";
const std::string kTenPeriods =
    "[integrate]\nsettle = 20\nrecord = 10\nstop = 'never'\nmax_step = 0.02\n" + kImpacts;

// A motion on one side does not know how wide the gap is.
TEST(Impacts, OnOneFlankDoNotDependOnTheBacklash) {
  const SweepResult result =
      run(kOneWave + "Fte = 0.3\nFm = 0.1\n[[axes]]\nname = 'b'\nvalues = [5.0, 7.0]\n" +
          "[initial]\npolicy = 'shifted'\n" + kTenPeriods);
  EXPECT_GT(impact_value(result, "drive", 0), 0.0);
  EXPECT_EQ(impact_value(result, "back", 0), 0.0);
  for (const char* const what : {"drive", "back", "speed", "depth"}) {
    EXPECT_NEAR(impact_value(result, what, 0), impact_value(result, what, 1), 1e-10) << what;
  }
}

// Negated, a motion without a load has its impacts on the other flank.
TEST(Impacts, ChangeFlanksInTheMirror) {
  const auto with = [](const std::string& sign) {
    return run(kOneWave + "Fm = 0.0\nFte = " + sign + "0.5\n[[axes]]\nname = 'b'\n" +
               "values = [0.1, 0.3]\n[initial]\npolicy = 'fixed'\nstate = {x = " + sign +
               "0.4, v = " + sign + "0.2}\n" + kTenPeriods);
  };
  const SweepResult result = with("");
  const SweepResult mirror = with("-");
  for (const std::size_t point : {0U, 1U}) {
    EXPECT_GT(impact_value(result, "drive", point), 0.0);
    EXPECT_EQ(impact_value(result, "drive", point), impact_value(mirror, "back", point));
    EXPECT_EQ(impact_value(result, "back", point), impact_value(mirror, "drive", point));
    for (const char* const what : {"speed", "depth"}) {
      EXPECT_NEAR(impact_value(result, what, point), impact_value(mirror, what, point), 1e-12);
    }
  }
}

// Two-sided, chaotic and wedged motions, a stop, and steps in which several limits are crossed: the
// other engine, with its own code.
TEST(Impacts, AgreeWithTheReferenceEngine) {
  const auto agree = [](const std::string& model, const std::string& steps,
                        const std::string& observe = kImpacts) {
    const std::string study = "[model]\n" + model +
                              "[integrate]\nsettle = 4\nrecord = 3\nstop = 'never'\n"
                              "steps_per_period = " +
                              steps + "\n" + observe;
    const SweepResult kernel = run(study);
    const SweepResult reference = run(study, {"integrate.engine='reference'"});
    double largest = 0.0;
    for (const Quantity& quantity : kernel.study.selection.quantities) {
      for (std::size_t point = 0; point < kernel.study.points(); ++point) {
        const double value = map_of(kernel, quantity.name)[point];
        EXPECT_NEAR(value, map_of(reference, quantity.name)[point], 1e-8)
            << model << quantity.name << " " << point;
        largest = std::max(largest, value);
      }
    }
    EXPECT_GT(largest, 0.0) << model;
  };
  for (const std::string steps : {"12", "128"}) {
    for (const std::string law : {"constant", "dynamic"}) {
      agree("preset = 'coarse'\nbacklash = '" + law +
                "'\n[[axes]]\nname = 'omega'\nfrom = 0.61\nto = 1.77\ncount = 7\n[[axes]]\n"
                "name = 'b'\nvalues = [0.0, 0.003, 0.03, 0.1, 0.25]\n",
            steps);
    }
  }
  agree("name = 'shaw_holmes'\n[[axes]]\nname = 'x'\nvalues = [0.0, 0.5]\n", "256",
        replaced(kImpacts, ", 'dmf_min', 'dmf_max'", ""));
}

// A periodic motion has the same counts in single precision, and what is measured to its digits.
TEST(Impacts, AreCountedInSinglePrecision) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.65, 1.0]\n[integrate]\n"
      "settle = 300\nrecord = 10\nstop = 'never'\nmax_step = 0.05\n" +
      kImpacts;
  const SweepResult fp64 = run(study);
  const SweepResult fp32 = run(study, {"integrate.precision=fp32"});
  for (const std::size_t point : {0U, 1U}) {
    EXPECT_EQ(impact_value(fp32, "drive", point), impact_value(fp64, "drive", point));
    EXPECT_EQ(impact_value(fp32, "back", point), impact_value(fp64, "back", point));
    EXPECT_NEAR(impact_value(fp32, "speed", point), impact_value(fp64, "speed", point), 1e-4);
    EXPECT_NEAR(impact_value(fp32, "depth", point), impact_value(fp64, "depth", point), 1e-4);
  }
}

// The list has the forcing periods of the motion of each attractor, and its impacts on each flank.
TEST(Impacts, StandInTheListOfAttractors) {
  const std::string study =
      "[model]\npreset = 'consistent'\n[[axes]]\nname = 'omega'\nvalues = [0.7, 1.2]\n"
      "[integrate]\nsettle = 1000\nrecord = 64\n[observe]\nquantities = ['attractor'";
  for (const Attractor& attractor : run(study + "]\n").attractors) {
    EXPECT_EQ(attractor.impacts, "");
  }
  const SweepResult result =
      run(study + ", 'contact_impacts_drive', 'contact_impacts_back', 'contact_losses']\n");
  ASSERT_EQ(result.attractors.size(), 2U);
  EXPECT_EQ(result.attractors[0].impacts, "1-0-0");  // no impact at 0.7
  EXPECT_EQ(result.attractors[1].period, 3.0);
  EXPECT_EQ(result.attractors[1].impacts,
            "3-" + std::to_string(std::lround(3.0 * map_of(result, "contact_losses")[1])) + "-0");
}

}  // namespace
}  // namespace gearsweep::testing
