// Telling attractors apart: unit tests with places made by hand, and systems whose attractors are
// known.
#include "attractors/attractor_census.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

constexpr std::size_t kPeriodic = 1, kChaotic = 3;

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
  made.place = std::move(box);
  return made;
}

// Chaos of two states whose moments have one error.
TrajectorySummary chaos(std::vector<double> moments, double error) {
  TrajectorySummary made = summary(kChaotic, 0, std::move(moments));
  made.errors.assign(made.place.size(), error);
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

TEST(Attractors, MomentsThatDifferByTheirErrorsAreOfOneAttractor) {
  const auto numbers = [](const std::vector<TrajectorySummary>& summaries) {
    return find_attractors(basin_study(summaries.size()), summaries).number;
  };
  using Numbers = std::vector<std::size_t>;
  EXPECT_EQ(numbers({chaos({0.1, 0.0, 1.0, 1.0}, 0.03), chaos({0.2, 0.0, 1.0, 1.0}, 0.03)}),
            (Numbers{1, 1}));
  // A longer record has smaller errors.
  EXPECT_EQ(numbers({chaos({0.1, 0.0, 1.0, 1.0}, 0.003), chaos({0.2, 0.0, 1.0, 1.0}, 0.003)}),
            (Numbers{1, 2}));
  EXPECT_EQ(numbers({chaos({0.1, 0.0, 1.0, 1.0}, 0.003), chaos({0.1, 0.0, 1.0, 0.9}, 0.003)}),
            (Numbers{2, 1}));
  // No error is so small that a thousandth of the motion counts.
  EXPECT_EQ(numbers({chaos({0.1, 0.0, 1.0, 1.0}, 0.0), chaos({0.101, 0.0, 1.0, 1.0}, 0.0)}),
            (Numbers{1, 1}));
  // Errors of one period's record are not known.
  EXPECT_EQ(numbers({chaos({0.1, 0.0, 1.0, 1.0}, NAN), chaos({0.9, 0.0, 1.0, 1.0}, NAN)}),
            (Numbers{1, 1}));
  // Periodic motion comes first, and is no chaos.
  EXPECT_EQ(
      numbers({chaos({0.1, 0.0, 1.0, 1.0}, 0.03), summary(kPeriodic, 1, {0.1, 0.0, 1.0, 1.0})}),
      (Numbers{2, 1}));
}

// So many trajectories on each of several attractors, whose means are apart by `apart` errors.
// Their numbers are those of std::mt19937_64, which the standard says.
std::vector<TrajectorySummary> crowd(std::size_t attractors, std::size_t of_each, double apart,
                                     double known_error) {
  constexpr double kError = 0.01;
  std::mt19937_64 random(7);
  // A normal number of unit variance, by the central limit.
  const auto normal = [&] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11U) * 0x1p-53;
    return sum;
  };
  std::vector<TrajectorySummary> out;
  for (std::size_t i = 0; i < attractors * of_each; ++i) {
    const double place = kError * apart * static_cast<double>(i % attractors);
    std::vector<double> moments = {place, 0.2, 0.8, 0.5};
    for (double& moment : moments) moment += kError * normal();
    out.push_back(chaos(moments, known_error * kError));
  }
  return out;
}

TEST(Attractors, ManyTrajectoriesTellWhatFewDoNot) {
  const auto counted = [](const std::vector<TrajectorySummary>& summaries) {
    return find_attractors(basin_study(summaries.size()), summaries).attractors.size();
  };
  // The errors may be worth little.
  for (const double known : {0.3, 1.0, 3.0}) EXPECT_EQ(counted(crowd(1, 1600, 0.0, known)), 1U);
  for (const double known : {0.3, 1.0}) EXPECT_EQ(counted(crowd(1, 8, 0.0, known)), 1U);
  EXPECT_EQ(counted(crowd(2, 1, 7.0, 1.0)), 1U);
  EXPECT_EQ(counted(crowd(2, 800, 7.0, 1.0)), 2U);
  EXPECT_EQ(counted(crowd(7, 43, 12.0, 1.0)), 7U);
}

// Two of 1,600 that are on their way: their errors say so.
TEST(Attractors, StragglersAreNoAttractors) {
  std::vector<TrajectorySummary> summaries = crowd(2, 800, 20.0, 1.0);
  summaries[10].place[0] = 0.09;
  summaries[10].errors[0] = 0.05;
  summaries[11].place[0] = 0.11;
  summaries[11].errors[0] = 0.05;
  const AttractorList list = find_attractors(basin_study(summaries.size()), summaries);
  ASSERT_EQ(list.attractors.size(), 2U);
  EXPECT_EQ(list.uncertain, 2U);
}

// The numbers of states have units, offsets and an order.
TEST(Attractors, AreTheSameInOtherUnits) {
  const std::vector<TrajectorySummary> summaries = crowd(3, 50, 15.0, 1.0);
  const auto numbers = [&](double unit, double offset, bool is_turned) {
    std::vector<TrajectorySummary> other = summaries;
    for (TrajectorySummary& one : other) {
      for (std::size_t i = 0; i < 4; i += 2) {
        one.place[i] *= std::abs(unit);
        one.errors[i] *= std::abs(unit);
      }
      if (unit < 0.0) one.place[0] *= -1.0;
      one.place[0] += offset;
      if (!is_turned) continue;
      for (std::vector<double>* list : {&one.place, &one.errors}) {
        std::swap((*list)[0], (*list)[1]);
        std::swap((*list)[2], (*list)[3]);
      }
    }
    return find_attractors(basin_study(other.size()), other).number;
  };
  const std::vector<std::size_t> expected = numbers(1.0, 0.0, false);
  EXPECT_EQ(std::ranges::max(expected), 3U);
  for (const double unit : {1e-9, 1e9}) EXPECT_EQ(numbers(unit, 0.0, false), expected);
  EXPECT_EQ(numbers(1.0, 1e3, false), expected);
  EXPECT_EQ(std::ranges::max(numbers(1.0, 0.0, true)), 3U);
  std::vector<std::size_t> mirrored = numbers(-1.0, 0.0, false);
  for (std::size_t& number : mirrored) number = 4 - number;
  EXPECT_EQ(mirrored, expected);
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

// Two stable cycles about each other, of radius 1 and 1.5, gone round once in 2 pi. A clock whose
// period is that of the cycles shows a point of theirs, another one from each start.
TEST(Attractors, CyclesAboutEachOtherAreTwoByAnyClock) {
  const SweepResult result =
      run("[model]\ntext = \"\"\"\n[model]\nname = 'cycles'\n[states]\nx = {}\ny = {}\n"
          "[parameters]\nclock = { value = 1.0, min = 0.1 }\n[constants]\n"
          "r = 'sqrt(x^2 + y^2)'\ng = '-(r - 1)*(r - 1.25)*(r - 1.5)/r'\n[equations]\n"
          "x = 'g*x - y'\ny = 'g*y + x'\n[forcing]\nperiod = 'clock'\n\"\"\"\n[[axes]]\n"
          "name = 'x'\nvalues = [-1.6, -1.1, -0.4, 0.5, 1.2, 1.4]\n[[axes]]\nname = 'clock'\n"
          "values = [1.0, 1.5707963267948966, 5.0, 6.283185307179586]\n[initial]\n"
          "policy = 'fixed'\n[initial.state]\ny = 0.1\n[integrate]\nsettle = 400\n[observe]\n"
          "quantities = ['attractor']\n");
  EXPECT_EQ(result.attractors.size(), 2U);
  for (std::size_t i = 0; i < map_of(result, "attractor").size(); ++i) {
    const double radius = std::hypot(result.study.axes[0].values[i % 6], 0.1);
    EXPECT_EQ(map_of(result, "attractor")[i], radius < 1.25 ? 1.0 : 2.0) << i;
  }
}

// Each mirrors the other: x and v change signs, half a period later. From 400 periods on some
// starts are still on their way there.
TEST(Attractors, ChaosMayHaveAMirrorImage) {
  const SweepResult result =
      run("[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\ndamping = 0.15\n"
          "amplitude = 0.3\nomega = 1.3\n[[axes]]\nname = 'x'\nfrom = -1.5\nto = 1.5\ncount = 8\n"
          "[[axes]]\nname = 'v'\nfrom = -1.5\nto = 1.5\ncount = 8\n[integrate]\nsettle = 4000\n"
          "max_step = 0.05\n[observe]\nquantities = ['attractor', 'x_mean']\n");
  ASSERT_EQ(result.attractors.size(), 2U);
  const std::vector<double> number = map_of(result, "attractor");
  const std::vector<double> mean = map_of(result, "x_mean");
  for (std::size_t i = 0; i < number.size(); ++i) {
    EXPECT_EQ(number[i] == number[0], (mean[i] > 0.0) == (mean[0] > 0.0)) << i;
  }
}

// The second engine keeps all values and looks at them about their mean.
TEST(StateMoments, AreThoseOfTheReferenceEngine) {
  const std::string quantities =
      "[observe]\nquantities = ['state_moments_mean', 'state_moments_std', "
      "'state_moments_mean_error', 'state_moments_std_error']\n[integrate]\nsettle = 5\n"
      "record = 37\nmax_step = 0.05\nstop = 'never'\n";
  const std::string section =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.65]\n";
  const std::string motion =
      "[model]\nname = 'rossler'\n[parameters]\nc = 3.0\n[initial]\npolicy = "
      "'fixed'\n[initial.state]\nx = 1\ny = 2\n"
      "z = 3\n[[axes]]\nname = 'a'\nvalues = [0.2]\n";
  for (const std::string& study : {section, motion}) {
    const SweepResult kernel = run(study + quantities);
    const SweepResult reference = run(study + quantities, {"integrate.engine=reference"});
    for (std::size_t quantity = 0; quantity < kernel.values.size(); ++quantity) {
      const std::vector<double>& expected = reference.values[quantity];
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(kernel.values[quantity][i], expected[i], 1e-8 * (1.0 + std::abs(expected[i])))
            << quantity << " " << i;
      }
    }
  }
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
