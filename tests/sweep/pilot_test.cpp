// The step that integrate.tolerance finds, judged by an oscillator whose orbit is known.
#include "sweep/pilot.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "journal/journal.hpp"
#include "model/error.hpp"
#include "support/folder.hpp"
#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kOscillator =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.1\nlinear = 2.0\ncubic = 0.0\n"
    "amplitude = 0.7\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.4\ncount = 41\n"
    "[observe]\nquantities = ['x_rms']\n";

// rms of the orbit of x'' + 0.1 x' + 2 x = 0.7 sin(omega t).
double exact_rms(double omega) {
  const std::complex<double> stiffness(2.0 - omega * omega, 0.1 * omega);
  return 0.7 / std::abs(stiffness) / std::numbers::sqrt2;
}

// Relative to the range of the map.
double max_error(const SweepResult& result) {
  const std::vector<double>& omega = result.study.axes[0].values;
  double error = 0.0, low = 1e9, high = 0.0;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double exact = exact_rms(omega[i]);
    error = std::max(error, std::abs(map_of(result, "x_rms")[i] - exact));
    low = std::min(low, exact);
    high = std::max(high, exact);
  }
  return error / (high - low);
}

double on_orbits(const FoundStep& step) {
  return step.max_step / static_cast<double>(step.orbit_steps);
}

class PilotTolerance : public ::testing::TestWithParam<const char*> {};

TEST_P(PilotTolerance, IsKeptAtEveryPointOfASmoothSystem) {
  const double tolerance = std::stod(GetParam());
  const SweepResult result = run(kOscillator, {std::string("integrate.tolerance=") + GetParam()});
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_EQ(result.study.integrate.max_step, result.pilot->step.max_step);
  EXPECT_EQ(result.pilot->points, 41U);
  EXPECT_EQ(result.pilot->sensitive, 0.0);
  EXPECT_LE(result.pilot->error, tolerance);
  EXPECT_LE(max_error(result), tolerance);
  EXPECT_EQ(result.pilot->errors.at("x_rms"), result.pilot->error);
  // The next longer step would not have done: its error is twice this one's. Or the longest step,
  // four times the model's own, is good enough.
  EXPECT_TRUE(result.pilot->step.max_step == 0.12 || result.pilot->error > tolerance / 4.0);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, PilotTolerance, ::testing::Values("1e-3", "1e-5", "1e-8"));

// A study that says nothing of its step, on the whole map: at 99 % of the periodic points each map
// is within a thousandth of its range of what short steps give.
TEST(Pilot, KeepsTheDefaultToleranceOnTheWholeMap) {
  const std::string gear =
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nzeta = 0.1\n[[axes]]\nname "
      "= 'omega'\nfrom = 0.45\n"
      "to = 1.9\ncount = 82\n[[axes]]\nname = 'e0'\nfrom = 0.02\nto = 0.3\ncount = 50\n"
      "[integrate]\nsettle = 2500\nrecord = 20\n[observe]\nquantities = ['dmf_max', 'x1_rms', "
      "'contact_class', 'contact_gap']\n";
  const SweepResult result = run(gear);
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_GT(result.pilot->step.max_step, result.study.model->max_step);
  EXPECT_LE(result.pilot->error, 1e-3);
  const SweepResult fine = run(gear, {"integrate.max_step=0.0125"});
  EXPECT_FALSE(fine.pilot.has_value());
  const auto periodic = std::count(fine.on_orbit.begin(), fine.on_orbit.end(), 1);
  ASSERT_GT(periodic, 2000);
  for (std::size_t map = 0; map < fine.values.size(); ++map) {
    const auto [low, high] = std::minmax_element(fine.values[map].begin(), fine.values[map].end());
    const bool is_class = !fine.study.selection.quantities[map].flags.empty();
    const double allowed = is_class ? 0.0 : 1e-3 * (*high - *low);
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < fine.status.size(); ++i) {
      const double error = std::abs(result.values[map][i] - fine.values[map][i]);
      if (fine.on_orbit[i] == 1 && error > allowed) ++beyond;
    }
    EXPECT_LE(static_cast<double>(beyond), 0.01 * static_cast<double>(periodic))
        << fine.study.selection.quantities[map].name;
  }
}

// A pilot run would take longer than it saves.
TEST(Pilot, IsLeftOutWhereItDoesNotPay) {
  const SweepResult result = run(kOscillator);
  EXPECT_FALSE(result.pilot.has_value());
  EXPECT_EQ(result.study.integrate.max_step, result.study.model->max_step);
}

// What it saves, it saves of each draw.
TEST(Pilot, PaysForFewPointsOfManyDraws) {
  const std::string draws =
      "[uncertain]\nsamples = 20000\nstart = 'nominal'\nzeta = {distribution = 'uniform', from = "
      "0.04, to = 0.06}\n";
  const std::optional<SteppedStudy> stepped = choose_step(
      read_study("[model]\npreset = 'consistent'\n[[axes]]\nname = 'omega'\nfrom = 0.9\nto = 1.2\n"
                 "count = 5\n[observe]\nquantities = ['x1_rms']\n" +
                     draws,
                 "test.toml"),
      SweepOptions());
  ASSERT_TRUE(stepped && stepped->pilot);
  EXPECT_GT(stepped->pilot->step.max_step, stepped->study.model->max_step);
}

// Where basins are interwoven, any change of the step sends some points to another orbit. The step
// is judged by the others.
TEST(Pilot, TellsWhichShareNoStepSettles) {
  const SweepResult result =
      run("[model]\nname = 'duffing'\n[parameters]\ndamping = 0.15\nlinear = -1.0\ncubic = 1.0\n"
          "amplitude = 0.25\nomega = 1.0\n[initial]\npolicy = 'fixed'\n[[axes]]\nname = 'x'\n"
          "from = -2.0\nto = 2.0\ncount = 40\n[[axes]]\nname = 'v'\nfrom = -2.0\nto = 2.0\n"
          "count = 40\n[integrate]\nsettle = 300\n[observe]\nquantities = ['x_mean', 'x_rms']\n",
          {"integrate.tolerance=1e-3"});
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_GT(result.pilot->sensitive, 0.1);
  EXPECT_LT(result.pilot->sensitive, 0.4);
  EXPECT_LE(result.pilot->error, 1e-3);
  EXPECT_GT(result.pilot->step.max_step, result.study.model->max_step);
}

// Without a correction where teeth meet, exponents converge at first order, and from step to step
// by chance. Shorter steps help all the same: such points are not taken for sensitive ones.
TEST(Pilot, GoesOnWhereShorterStepsHelpSlowly) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.45\nto = 1.9\ncount = 24\n"
      "[[axes]]\nname = 'e0'\nfrom = 0.07\nto = 0.75\ncount = 14\n[integrate]\nevents = false\n"
      "settle = 300\nrecord = 100\n[observe]\nquantities = ['lyapunov_max']\n";
  const SweepResult result = run(study, {"integrate.tolerance=0.01"});
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_LT(result.pilot->sensitive, 0.02);
  EXPECT_LT(on_orbits(result.pilot->step), result.study.model->max_step);
  const SweepResult fine = run(study, {"integrate.max_step=0.0008"});
  const std::vector<double>& exponents = map_of(fine, "lyapunov_max");
  const auto [low, high] = std::minmax_element(exponents.begin(), exponents.end());
  std::size_t periodic = 0, beyond = 0;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (fine.on_orbit[i] == 0) continue;
    ++periodic;
    const double error = std::abs(map_of(result, "lyapunov_max")[i] - exponents[i]);
    if (error > 0.01 * (*high - *low)) ++beyond;
  }
  ASSERT_GT(periodic, 150U);
  EXPECT_LE(static_cast<double>(beyond), 0.02 * static_cast<double>(periodic));
}

// Motion on one flank does not know the backlash (model.md, exact test 4), and neither does the
// step that it needs, though the backlash is the offset of all its states.
TEST(Pilot, DoesNotKnowTheOffsetOfTheMotion) {
  const auto pilot = [](double b) {
    return run(fmt::format(
                   "[model]\npreset = 'consistent'\n[parameters]\nF1 = 0.5\ne0 = 0.1\nb = "
                   "{}\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.2\ncount = 6\n"
                   "[observe]\nquantities = ['x1_std', 'dmf_max']\n[integrate]\ntolerance = "
                   "1e-5\n",
                   b))
        .pilot.value();
  };
  const PilotFindings near = pilot(1.0), far = pilot(300.0);
  EXPECT_EQ(near.points, 6U);
  EXPECT_EQ(far.points, 6U);
  EXPECT_EQ(far.step.max_step, near.step.max_step);
  EXPECT_NEAR(far.error, near.error, 1e-3 * near.error);
}

std::string refusal(const std::string& toml, const std::vector<std::string>& overrides) {
  try {
    run(toml, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Exponents take shorter steps than other maps of the same study.
TEST(Pilot, HasAToleranceForExponents) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.45\nto = 1.9\ncount = 24\n"
      "[[axes]]\nname = 'e0'\nfrom = 0.07\nto = 0.75\ncount = 12\n[integrate]\nsettle = "
      "300\nrecord = "
      "60\n[observe]\nquantities = ['x1_rms', 'lyapunov_max']\n";
  const PilotFindings same = run(study, {"integrate.exponent_tolerance=1e-5"}).pilot.value();
  const PilotFindings looser = run(study, {"integrate.exponent_tolerance=0.02"}).pilot.value();
  EXPECT_LE(same.errors.at("lyapunov_max"), 1e-5);
  EXPECT_LE(looser.errors.at("lyapunov_max"), 0.02);
  EXPECT_LE(looser.errors.at("x1_rms"), 1e-3);
  EXPECT_GT(on_orbits(looser.step), on_orbits(same.step));
  EXPECT_THAT(refusal(replaced(kOscillator, "'x_rms'", "'x_rms', 'lyapunov_max'"),
                      {"integrate.exponent_tolerance=1e-10", "integrate.precision=fp32"}),
              AllOf(HasSubstr("integrate.exponent_tolerance = 1e-10"), HasSubstr("lyapunov")));
}

// Exponents of orbits alone need short steps here: the run keeps those of the other maps.
TEST(Pilot, GivesShorterStepsToOrbitsWhereExponentsNeedThem) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.45\nto = 1.9\ncount = 24\n"
      "[[axes]]\nname = 'e0'\nfrom = 0.07\nto = 0.75\ncount = 12\n[integrate]\nsettle = "
      "300\nrecord = 60\n[observe]\nquantities = [";
  const std::string with = study + "'x1_rms', 'lyapunov_max']\n";
  const SweepResult result = run(with, {"integrate.tolerance=1e-3"});
  const FoundStep found = result.pilot->step;
  EXPECT_EQ(found.orbit_steps, 4U);
  EXPECT_EQ(result.study.integrate.orbit_steps, 4U);
  const SweepResult others = run(study + "'x1_rms']\n", {"integrate.tolerance=1e-3"});
  EXPECT_LE(found.max_step, others.pilot->step.max_step);
  EXPECT_EQ(others.pilot->step.orbit_steps, 1U);
  // What comes later takes the same steps.
  const SweepResult again = run(with, found.overrides());
  EXPECT_EQ(map_of(again, "lyapunov_max"), map_of(result, "lyapunov_max"));
  EXPECT_EQ(map_of(again, "x1_rms"), map_of(result, "x1_rms"));
  // Attractors are told apart by where motions are: they ask for equal steps of all.
  const SweepResult told = run(study + "'lyapunov_max', 'attractor']\n",
                               {"integrate.tolerance=0.01", "integrate.record=40"});
  EXPECT_EQ(told.pilot->step.orbit_steps, 1U);
}

// Whatever is asked of exponents and of other maps, a step is judged by a shorter one. The exponent
// of a damped linear oscillator is known: half of its damping.
TEST(Pilot, JudgesStepsOnOrbitsByShorterOnes) {
  // At 3e-7 maps ask for the model's own step, that of the first run.
  for (const char* maps : {"1e-4", "1e-6", "3e-7", "1e-7"}) {
    for (const double exponents : {1e-6, 1e-8}) {
      SCOPED_TRACE(fmt::format("{} {}", maps, exponents));
      const SweepResult result = run(replaced(kOscillator, "'x_rms'", "'x_rms', 'lyapunov_max'"),
                                     {std::string("integrate.tolerance=") + maps,
                                      fmt::format("integrate.exponent_tolerance={}", exponents)});
      ASSERT_TRUE(result.pilot.has_value());
      EXPECT_GT(result.pilot->error, 0.0);
      EXPECT_LE(max_error(result), 2.0 * std::stod(maps));
      for (const double exponent : map_of(result, "lyapunov_max")) {
        EXPECT_NEAR(exponent, -0.05, 2.0 * exponents * 0.05);
      }
    }
  }
}

// In SI units the model's step is longer than any period, so that a period has the same few steps
// whatever longer step is asked for.
TEST(Pilot, ComparesNoGridWithItself) {
  const SweepResult result = run(
      "[model]\ntext = '''\n[model]\nname = \"tuned_pilot\"\nmax_step = 0.05\n[states]\nx = {}\n"
      "v = {}\n[parameters]\nf = 500.0\nzeta = 0.01\nwn = 9424.77796076938\n[equations]\nx = "
      "\"v\"\nv = \"cos(phase) - 2*zeta*wn*v - wn^2*x\"\n[forcing]\nperiod = \"1/f\"\n'''\n"
      "[[axes]]\nname = 'f'\nvalues = [500.0, 900.0, 1300.0, 1400.0, 2000.0, 3000.0]\n"
      "[integrate]\nsettle = 1000\nrecord = 20\ntolerance = 1e-6\n[observe]\nquantities = "
      "['x_rms']\n");
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_LE(result.pilot->error, 1e-6);
  const std::vector<double>& f = result.study.axes[0].values;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double omega = 2.0 * std::numbers::pi * f[i], own = 9424.77796076938;
    const std::complex<double> stiffness(own * own - omega * omega, 0.02 * own * omega);
    const double exact = 1.0 / std::abs(stiffness) / std::numbers::sqrt2;
    EXPECT_NEAR(map_of(result, "x_rms")[i], exact, 2e-6 * 6.2e-8) << f[i];
  }
}

TEST(Pilot, RefusesATwofoldDemand) {
  EXPECT_THAT(refusal(kOscillator, {"integrate.tolerance=1e-4", "integrate.max_step=0.01"}),
              HasSubstr("not both"));
}

TEST(Pilot, SaysWhatFp32CannotDo) {
  EXPECT_THAT(refusal(kOscillator, {"integrate.tolerance=1e-9", "integrate.precision=fp32"}),
              HasSubstr("fp32 has no more digits"));
}

TEST(Pilot, SaysThatChaosTellsNothing) {
  EXPECT_THAT(refusal("[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [28.0, 29.0]\n"
                      "[integrate]\nsettle = 40\n[observe]\nquantities = ['x_rms']\n",
                      {"integrate.tolerance=1e-4"}),
              HasSubstr("arrive on a periodic orbit"));
}

// A run is there for others from its first moment.
TEST(Pilot, LetsOthersSeeTheRun) {
  const Folder folder;
  SweepOptions options;
  options.journal_path = (folder / "map.nc.journal").string();
  bool is_held = false;
  options.on_pilot = [&](std::size_t) { is_held = Journal::status(options.journal_path).is_held; };
  EXPECT_TRUE(run_sweep(read_study(kOscillator, "test", {"integrate.tolerance=1e-3"}), options));
  EXPECT_TRUE(is_held);
  EXPECT_TRUE(folder.files().empty());
}

// The message names what the study has, not the default beside it.
TEST(Pilot, NamesTheToleranceThatIsAskedFor) {
  EXPECT_THAT(refusal("[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [28.0, 29.0]\n"
                      "[integrate]\nsettle = 40\n[observe]\nquantities = ['x_rms']\n",
                      {"integrate.exponent_tolerance=0.02"}),
              AllOf(HasSubstr("integrate.exponent_tolerance = 0.02"),
                    HasSubstr("arrive on a periodic orbit")));
}

// Nobody has asked for a tolerance.
TEST(Pilot, WarnsWhereItTellsNothing) {
  const Study study = read_study(
      "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nfrom = 28.0\nto = 29.0\ncount = 64\n"
      "[[axes]]\nname = 'sigma'\nfrom = 10.0\nto = 10.5\ncount = 64\n[integrate]\nsettle = 40\n"
      "record = 4000\n[observe]\nquantities = ['x_rms']\n",
      "pilot_test");
  std::string warning;
  SweepOptions options;
  options.warn = [&](const std::string& text) { warning = text; };
  const std::optional<SteppedStudy> stepped = choose_step(study, options);
  ASSERT_TRUE(stepped);
  EXPECT_FALSE(stepped->pilot);
  EXPECT_EQ(stepped->study.integrate.max_step, study.model->max_step);
  EXPECT_THAT(warning, AllOf(HasSubstr("the pilot run found no step"),
                             HasSubstr("arrive on a periodic orbit")));
}

}  // namespace
}  // namespace gearsweep::testing
