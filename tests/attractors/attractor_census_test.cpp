// Telling attractors apart: unit tests with boxes made by hand, and systems whose attractors are
// known.
#include "attractors/attractor_census.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

constexpr std::size_t kPeriodic = 1, kQuasiPeriodic = 2, kChaotic = 3;

Study basin_study(std::size_t count) {
  return read_study("[model]\nname = 'duffing'\n[[axes]]\nname = 'x'\nfrom = -1\nto = 1\ncount = " +
                        std::to_string(count) + "\n[observe]\nquantities = ['attractor']\n",
                    "test");
}

Study branch_study(std::size_t count) {
  return read_study(
      "[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nfrom = 1\nto = 2\ncount = " +
          std::to_string(count) + "\n[observe]\nquantities = ['attractor']\n",
      "test");
}

TrajectorySummary summary(std::size_t motion, double period, std::vector<double> box) {
  TrajectorySummary made;
  made.is_known = true;
  made.motion = motion;
  made.period = period;
  made.box = std::move(box);
  return made;
}

TEST(Attractors, PeriodicOnesAreTheSameWhenTheirBoxesAgree) {
  const AttractorList list =
      find_attractors(basin_study(4), {summary(kPeriodic, 3, {0.5, -0.1, 1.0, 0.2}),
                                       summary(kPeriodic, 3, {0.5, -0.1, 1.0005, 0.2}),
                                       summary(kPeriodic, 3, {0.5, -0.1, 1.0, 0.21}),
                                       summary(kPeriodic, 1, {-0.7, 0.0, -0.7, 0.0})});
  // Period 1 comes first, whatever the order of the points.
  EXPECT_EQ(list.number, (std::vector<std::size_t>{2, 2, 3, 1}));
  ASSERT_EQ(list.attractors.size(), 3U);
  EXPECT_EQ(list.attractors[1].trajectories, 2U);
  EXPECT_EQ(list.attractors[1].period, 3.0);
}

TEST(Attractors, ChaosFillsItsBoxOnlyRoughly) {
  const AttractorList list =
      find_attractors(basin_study(4), {summary(kChaotic, 0, {-1.0, -1.0, 1.0, 1.0}),
                                       summary(kQuasiPeriodic, 0, {-0.9, -1.1, 0.8, 1.0}),
                                       summary(kChaotic, 0, {0.1, -1.0, 1.0, 1.0}),
                                       summary(kPeriodic, 1, {-1.0, -1.0, 1.0, 1.0})});
  EXPECT_EQ(list.number, (std::vector<std::size_t>{2, 2, 3, 1}));
}

TEST(Attractors, UndecidedTrajectoriesReachNone) {
  TrajectorySummary unknown;
  const AttractorList list =
      find_attractors(basin_study(2), {unknown, summary(kPeriodic, 1, {0.0, 0.0, 0.0, 0.0})});
  EXPECT_EQ(list.number, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(list.count, (std::vector<std::size_t>{0, 1}));
}

// A branch that moves by little from one value to the next keeps its number; a jump and a change of
// period end it.
TEST(Attractors, AreFollowedAlongAParameter) {
  std::vector<TrajectorySummary> summaries;
  for (int i = 0; i < 10; ++i) {
    const double x = i < 5 ? 1.0 + 0.02 * i : 0.2;
    summaries.push_back(summary(kPeriodic, i < 8 ? 1.0 : 2.0, {x, 0.0, x, 0.0}));
  }
  const AttractorList list = find_attractors(branch_study(10), summaries);
  EXPECT_EQ(list.number, (std::vector<std::size_t>{2, 2, 2, 2, 2, 1, 1, 1, 3, 3}));
}

// A ball that rolls in two equal wells, with friction and nothing else, comes to rest in one of
// them, at x = -1 or 1.
const std::string kWells =
    "[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\namplitude = 0\n[integrate]\n"
    "settle = 30\nrecord = 20\nmax_step = 0.1\n";

TEST(Attractors, TwoWellsShareThePlaneOfInitialStatesByPointSymmetry) {
  const SweepResult result =
      run(kWells +
          "[[axes]]\nname = 'x'\nfrom = -2.1\nto = 2.1\ncount = 22\n[[axes]]\nname = 'v'\n"
          "from = -2.1\nto = 2.1\ncount = 22\n[observe]\nquantities = ['attractor', 'x_mean']\n");
  ASSERT_EQ(result.attractors.size(), 2U);
  for (const Attractor& attractor : result.attractors) {
    EXPECT_EQ(attractor.trajectories, 242U);
    EXPECT_EQ(attractor.motion, kPeriodic);
    EXPECT_EQ(attractor.period, 1.0);
    EXPECT_NEAR(attractor.rms, 1.0, 1e-9);  // what is left of exp(-0.125 t) after 30 periods
    EXPECT_TRUE(std::isnan(attractor.peak));
    // Small vibrations in a well decay by half the damping, 0.25.
    EXPECT_NEAR(attractor.exponent, -0.125, 0.01);
  }
  const std::vector<double> number = map_of(result, "attractor");
  const std::vector<double> mean = map_of(result, "x_mean");
  for (std::size_t i = 0; i < number.size(); ++i) {
    EXPECT_EQ(number[i], mean[i] < 0.0 ? 1.0 : 2.0) << i;
    EXPECT_EQ(number[i] + number[number.size() - 1 - i], 3.0) << i;
  }
}

TEST(Attractors, AnEnsembleCountsTheWells) {
  // linear = -1: two wells; linear = 1: one.
  const std::string axis = "[[axes]]\nname = 'linear'\nvalues = [-1.0, 1.0]\n";
  const SweepResult result = run(kWells + axis +
                                 "[initial]\nensemble = 8\nspread = {x = 2, v = 1}\n[observe]\n"
                                 "quantities = ['attractor_count', 'motion_class', 'x_mean']\n");
  EXPECT_EQ(map_of(result, "attractor_count"), (std::vector<double>{2.0, 1.0}));
  std::size_t trajectories = 0;
  for (const Attractor& attractor : result.attractors) trajectories += attractor.trajectories;
  // The one that starts at rest between the two wells stays there and is undecided.
  EXPECT_EQ(trajectories, 15U);
  // The other maps are those of the trajectories that the study has without an ensemble.
  const SweepResult alone = run(kWells + axis + "[observe]\nquantities = ['x_mean']\n");
  EXPECT_EQ(map_of(result, "x_mean"), map_of(alone, "x_mean"));
}

TEST(Attractors, NumbersDoNotDependOnHowTheWorkIsCut) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[parameters]\nomega = 0.801\nzeta = 0.02\ne0 = 0.5\n"
      "[[axes]]\nname = 'x1'\nfrom = -1\nto = 4\ncount = 12\n[[axes]]\nname = 'v1'\nfrom = -1.5\n"
      "to = 1.5\ncount = 8\n[integrate]\nsettle = 300\nrecord = 60\nmax_step = 0.1\n"
      "[observe]\nquantities = ['attractor', 'contact_class']\n";
  const SweepResult expected = run(study);
  // In contact all the time, and with impacts at twice the period: they live side by side.
  ASSERT_EQ(expected.attractors.size(), 2U);
  EXPECT_EQ(expected.attractors[0].period, 1.0);
  EXPECT_EQ(expected.attractors[1].period, 2.0);
  EXPECT_GT(expected.attractors[1].peak, 2.0 * expected.attractors[0].peak);
  const std::vector<double> contact = map_of(expected, "contact_class");
  for (std::size_t i = 0; i < contact.size(); ++i) {
    EXPECT_EQ(map_of(expected, "attractor")[i], contact[i] + 1.0) << i;
  }
  const SweepResult cut = run(study, {"integrate.tile=17", "integrate.lanes=2"});
  EXPECT_EQ(map_of(cut, "attractor"), map_of(expected, "attractor"));
}

// The second engine keeps all sections and takes their extremes at the end.
TEST(Section, IsTheBoxThatTheSamplesFillInBothEngines) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.65, 1.2, 1.98]\n"
      "[integrate]\nsettle = 20\nrecord = 30\nstop = 'never'\n[observe]\npoincare = ['x2', 'v1']\n"
      "quantities = ['section_min', 'section_max', 'poincare']\n";
  const SweepResult kernel = run(study);
  const SweepResult reference = run(study, {"integrate.engine=reference"});
  // With the state where the record begins, which is the sample before its first.
  const SweepResult longer = run(study, {"integrate.settle=19", "integrate.record=31"});
  for (std::size_t point = 0; point < 3; ++point) {
    for (std::size_t state = 0; state < 10; ++state) {
      const std::size_t at = point * 10 + state;
      // What rounding grows to in 50 periods.
      EXPECT_NEAR(map_of(kernel, "section_min")[at], map_of(reference, "section_min")[at], 1e-9);
      EXPECT_NEAR(map_of(kernel, "section_max")[at], map_of(reference, "section_max")[at], 1e-9);
    }
    for (std::size_t chosen = 0; chosen < 2; ++chosen) {
      const std::vector<double> samples = samples_of(longer, point, chosen);
      const auto [min, max] = std::minmax_element(samples.begin(), samples.end());
      const std::size_t at = point * 10 + (chosen == 0 ? 1 : 5);
      EXPECT_EQ(map_of(kernel, "section_min")[at], *min);
      EXPECT_EQ(map_of(kernel, "section_max")[at], *max);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
