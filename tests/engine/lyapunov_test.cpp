// Lyapunov exponents against what is known exactly (their sum, Floquet multipliers), against the
// growth of a small difference, and against the reference engine, which has its own way to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "reference/detail/trajectory.hpp"
#include "support/bits.hpp"
#include "support/eigenvalues.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"
#include "verify/detail/exact_answers.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Gt;
using ::testing::Lt;

const std::string kObserveExponents =
    "[observe]\nquantities = ['lyapunov_max', 'lyapunov_max_error', 'lyapunov_max_per_period', "
    "'lyapunov_spectrum', 'kaplan_yorke', 'contact_class']\n";

// The exponents of one point, in the order of the tangent vectors.
std::vector<double> spectrum_of(const SweepResult& result, std::size_t point) {
  const std::vector<double>& all = map_of(result, "lyapunov_spectrum");
  const std::size_t width = all.size() / result.status.size();
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(point * width);
  return {first, first + static_cast<std::ptrdiff_t>(width)};
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Chaos and impacts with any friction and contact ratio. Without the largest exponent and its
// error, which take the kernels of the search for orbits.
void expect_exact_sums(const std::string& model, const std::string& parameters,
                       double contact_class = 1.0, const std::string& max_step = "0.02") {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\n" + model + "[parameters]\n" + parameters +
          "[[axes]]\nname = 'mu'\nvalues = [0.0, 0.05, 0.2]\n[[axes]]\nname = 'eps'\n"
          "values = [1.2, 1.5, 1.718, 1.95]\n[integrate]\nmax_step = " +
          max_step +
          "\nsettle = 20\nrecord = 40\nstop = 'never'\n"
          "[observe]\nquantities = ['lyapunov_spectrum', 'contact_class']\n");
  EXPECT_THAT(result.status, Each(0));
  EXPECT_THAT(map_of(result, "contact_class"), Contains(Ge(contact_class)));
  const Plan plan(result.study, 256);
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const double exact = gear5_exponent_sum(plan.setting_of(point));
    // What the Runge-Kutta method leaves of the trace falls with the fourth power of the step: 1e-9
    // was seen. Corrected steps in which contact is lost or met leave as much again and more: 7e-9.
    EXPECT_NEAR(sum(spectrum_of(result, point)), exact, 2e-8) << "point " << point;
  }
}

TEST(LyapunovSum, ConsistentConstantBacklash) {
  expect_exact_sums("backlash = 'constant'\n", "omega = 1.35\n");
}
TEST(LyapunovSum, ConsistentDynamicBacklash) {
  expect_exact_sums("backlash = 'dynamic'\n", "omega = 1.35\n");
}
// Both flanks at once stiffen the mesh; the trace, which stiffness is no part of, stays. More
// crossings and a stiffer mesh leave 2.6e-8 of it at a step of 0.02, and 1.7e-9 at half of that.
TEST(LyapunovSum, WedgedTooth) {
  expect_exact_sums("backlash = 'dynamic'\n", "omega = 0.9\nb = 0.05\n", 3.0, "0.01");
}
TEST(LyapunovSum, ConsistentUnequalMasses) {
  expect_exact_sums("backlash = 'dynamic'\n", "omega = 1.1\nm2 = 0.2\nc3 = 1.0\nc4 = 3.0\n");
}
// A softer tooth and an eccentric pinion: neither is a part of the trace.
TEST(LyapunovSum, FaultsOfAGear) {
  expect_exact_sums("error = 'series'\n",
                    "omega = 1.35\nzp = 5\ncycle = 5\nrunout_p = 1.0\ndamage_p = 0.5\n");
}
TEST(LyapunovSum, PrintedConstantBacklash) {
  expect_exact_sums("backlash = 'constant'\nformulation = 'printed'\n",
                    "omega = 1.0\nm1 = 0.04\nm2 = 0.04\n");
}
TEST(LyapunovSum, PrintedDynamicBacklash) {
  expect_exact_sums("backlash = 'dynamic'\nformulation = 'printed'\n",
                    "omega = 1.0\nm1 = 0.04\nm2 = 0.04\n");
}

// Both engines do the same steps. They round differently, and chaos makes 1e-15 into 1e-11 over the
// 130 units of time that the chaotic runs last.
void expect_exponents_agree(const std::string& toml, double tolerance) {
  const SweepResult kernel = run(toml + kObserveExponents);
  const SweepResult reference = run(toml + kObserveExponents, {"integrate.engine='reference'"});
  EXPECT_THAT(kernel.status, Each(0));
  EXPECT_THAT(reference.status, Each(0));
  for (const Quantity& quantity : kernel.study.selection.quantities) {
    const std::vector<double>& a = map_of(kernel, quantity.name);
    const std::vector<double>& b = map_of(reference, quantity.name);
    ASSERT_EQ(a.size(), b.size());
    // The reference engine tells the standard error alone.
    const bool is_error = quantity.name == "lyapunov_max_error";
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double expected = is_error ? std::max(a[i], b[i]) : b[i];
      EXPECT_NEAR(a[i], expected, tolerance) << quantity.name << ", number " << i;
    }
  }
}

// Orbits without impact and with it; both backlash laws. At omega = 0.25 the tangent vectors lose
// six digits against each other in a period, hence 1e-9.
TEST(LyapunovEngines, AgreeOnRegularOrbits) {
  for (const std::string law : {"constant", "dynamic"}) {
    expect_exponents_agree("[model]\npreset = 'coarse'\nbacklash = '" + law +
                               "'\n[[axes]]\nname = 'omega'\nvalues = [0.25, 0.65, 0.8, 1.0]\n"
                               "[integrate]\nsettle = 60\nrecord = 40\n",
                           1e-9);
  }
}

TEST(LyapunovEngines, AgreeOnWedgedTeeth) {
  expect_exponents_agree(
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[[axes]]\nname = 'omega'\n"
      "values = [0.48, 0.5021]\n[[axes]]\nname = 'b'\nvalues = [0.02, 0.1, 0.2553]\n"
      "[integrate]\nsettle = 60\nrecord = 40\n",
      1e-9);
}

TEST(LyapunovEngines, AgreeOnChaosForSomePeriods) {
  for (const std::string law : {"constant", "dynamic"}) {
    expect_exponents_agree("[model]\npreset = 'coarse'\nbacklash = '" + law +
                               "'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
                               "values = [1.3, 1.35, 1.4, 1.7]\n[integrate]\nsettle = 10\n"
                               "record = 17\n",
                           1e-10);
  }
}

const std::string kChaos =
    "[model]\npreset = 'coarse'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
    "values = [1.3, 1.35, 1.4, 1.7]\n";

// Two trajectories of chaos: as estimates of one number they differ by less than 5 standard errors
// (which are themselves known to a fifth, from 16 blocks).
TEST(LyapunovFp32, ChaosHasTheExponentOfFp64) {
  const std::string toml =
      kChaos + "[integrate]\nsettle = 400\nrecord = 3200\n" + kObserveExponents;
  const SweepResult exact = run(toml);
  const SweepResult single = run(toml, {"integrate.precision=fp32"});
  for (std::size_t i = 0; i < exact.status.size(); ++i) {
    const double error =
        std::hypot(map_of(exact, "lyapunov_max_error")[i], map_of(single, "lyapunov_max_error")[i]);
    EXPECT_GT(map_of(exact, "lyapunov_max")[i], 0.02);
    EXPECT_LT(error, 0.005);
    EXPECT_NEAR(map_of(single, "lyapunov_max")[i], map_of(exact, "lyapunov_max")[i], 5.0 * error);
    // Rounding at 1e-7 a step, which sums up as a random walk.
    EXPECT_NEAR(sum(spectrum_of(single, i)), sum(spectrum_of(exact, i)), 5e-6);
  }
}

// Over a period of 3000 units of time a vector shrinks by e^-50, most of it by e^-300, in one
// segment of the phase grid. All exponents stay numbers; the largest keeps its digits: fp32 rounds
// at 1e-7 each step, so 1e-5 has room.
TEST(LyapunovFp32, LongPeriodsNeitherOverflowNorVanish) {
  const std::string toml =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.002, 0.005, 0.02, 0.1]\n"
      "[integrate]\nsettle = 2\nrecord = 8\n" +
      kObserveExponents;
  const SweepResult exact = run(toml);
  const SweepResult single = run(toml, {"integrate.precision=fp32"});
  for (std::size_t i = 0; i < single.status.size(); ++i) {
    EXPECT_NEAR(map_of(single, "lyapunov_max")[i], map_of(exact, "lyapunov_max")[i], 1e-5);
    EXPECT_THAT(spectrum_of(single, i), Each(AllOf(Gt(-1.0), Lt(0.0))));
  }
}

// Where teeth meet and part the Jacobian jumps inside a step; the tangent vectors of a corrected
// step are the derivative of what the state does. At the default step all exponents are those of
// the finest steps: 1.3e-6 was seen, and 8e-4 without the correction.
TEST(LyapunovEvents, ExponentsAreConvergedAtTheDefaultStep) {
  const std::string toml =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.65, 0.9]\n" +
      kObserveExponents;
  const SweepResult result = run(toml);
  const SweepResult plain = run(toml, {"integrate.events=false"});
  const SweepResult fine = run(toml, {"integrate.steps_per_period=2048"});
  const auto error = [&](const SweepResult& found, std::size_t point) {
    double max = 0.0;
    for (std::size_t i = 0; i < 10; ++i) {
      max = std::max(max, std::abs(spectrum_of(found, point)[i] - spectrum_of(fine, point)[i]));
    }
    return max;
  };
  for (std::size_t point = 0; point < 2; ++point) {
    EXPECT_GE(map_of(result, "contact_class")[point], 1.0);
    EXPECT_LT(error(result, point), 5e-6);
    EXPECT_GT(error(plain, point), 1e-4);
  }
}

// The same where both flanks touch at once and each limit is crossed on its own.
TEST(LyapunovEvents, ExponentsOfWedgedTeethAreConvergedToo) {
  const std::string toml =
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nb = 0.2553\n[[axes]]\n"
      "name = 'omega'\nvalues = [0.5021]\n[integrate]\nsteps_per_period = 512\n" +
      kObserveExponents;
  const SweepResult result = run(toml);
  const SweepResult fine = run(toml, {"integrate.steps_per_period=2048"});
  EXPECT_EQ(map_of(result, "contact_class")[0], 3.0);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(spectrum_of(result, 0)[i], spectrum_of(fine, 0)[i], 1e-6) << "exponent " << i;
  }
}

// Two trajectories that start 1e-12 apart: once their difference points where differences grow the
// fastest, it grows as the tangent vector does.
TEST(Lyapunov, IsTheGrowthOfASmallDifference) {
  constexpr std::size_t kRecord = 40;
  const std::string common =
      kChaos + "[[axes]]\nname = 'x1'\nvalues = " + digits(std::vector<double>{1.2, 1.2 + 1e-12}) +
      "\n[initial]\npolicy = 'fixed'\nstate = {x3 = 0.1}\n";
  const SweepResult tangent =
      run(common + "[integrate]\nsettle = 60\nrecord = 40\n" + kObserveExponents);
  // The first sample is taken where the other run begins to record.
  const SweepResult states =
      run(common + "[integrate]\nsettle = 59\nrecord = 41\n" + kObserveGear5);
  const std::size_t points = states.study.axes[0].values.size();
  for (std::size_t i = 0; i < points; ++i) {
    const auto distance = [&](std::size_t period) {
      double squares = 0.0;
      for (std::size_t state = 0; state < 10; ++state) {
        const double offset =
            samples_of(states, points + i, state)[period] - samples_of(states, i, state)[period];
        squares += offset * offset;
      }
      return std::sqrt(squares);
    };
    const double growth = std::log(distance(kRecord) / distance(0));
    const double expected =
        map_of(tangent, "lyapunov_max_per_period")[i] * static_cast<double>(kRecord);
    EXPECT_GT(expected, 2.0);
    // The difference reaches 1e-4 in the end, and is no longer small to that share.
    EXPECT_NEAR(growth, expected, 1e-3) << "point " << i;
  }
}

// log|multipliers|/T of the orbit that a point settles on, the largest first: the monodromy matrix
// by central differences of the reference trajectory over one period.
std::vector<double> floquet_exponents(const Plan& plan, std::size_t point) {
  const std::vector<double> initial = plan.own_initial_state(point);
  const auto states = static_cast<Eigen::Index>(initial.size());
  Trajectory orbit(plan, point, Eigen::Map<const Eigen::VectorXd>(initial.data(), states));
  for (int i = 0; i < 600; ++i) orbit.advance_period();
  const Eigen::VectorXd base = orbit.state();
  const auto ahead = [&](Eigen::Index state, double offset) {
    Eigen::VectorXd start = base;
    start[state] += offset;
    Trajectory near(plan, point, start);
    near.advance_period();
    return near.state();
  };
  constexpr double kOffset = 1e-6;
  EXPECT_LT((ahead(0, 0.0) - base).norm(), 1e-9) << "not an orbit of one period";
  Eigen::MatrixXd monodromy(states, states);
  for (Eigen::Index j = 0; j < states; ++j) {
    monodromy.col(j) = (ahead(j, kOffset) - ahead(j, -kOffset)) / (2.0 * kOffset);
  }
  std::vector<double> exponents;
  for (const std::complex<double>& multiplier : eigenvalues_of(monodromy)) {
    exponents.push_back(std::log(std::abs(multiplier)) / orbit.period());
  }
  std::sort(exponents.begin(), exponents.end(), std::greater<>());
  return exponents;
}

// Equal gears have motions of which some of the first tangent vectors have no share but rounding,
// so that it takes hundreds of periods until the fastest is found: a long warm-up.
TEST(Lyapunov, IsTheFloquetExponentOfAPeriodicOrbit) {
  for (const std::string law : {"constant", "dynamic"}) {
    const SweepResult result = run("[model]\npreset = 'coarse'\nbacklash = '" + law +
                                   "'\n[[axes]]\nname = 'omega'\nvalues = [0.65, 0.8, "
                                   "1.0]\n[integrate]\nsettle = 2000\nwarm_up = 2000\n"
                                   "record = 2000\n" +
                                   kObserveExponents);
    EXPECT_THAT(map_of(result, "contact_class"), Contains(Ge(1.0)));
    const Plan plan(result.study, 256);
    for (std::size_t i = 0; i < result.status.size(); ++i) {
      std::vector<double> exponents = spectrum_of(result, i);
      std::sort(exponents.begin(), exponents.end(), std::greater<>());
      const std::vector<double> floquet = floquet_exponents(plan, i);
      for (std::size_t j = 0; j < exponents.size(); ++j) {
        // The vectors turn from period to period, which leaves a few parts of 1 over the length of
        // the record (2000 periods of 6 to 10 units of time).
        EXPECT_NEAR(exponents[j], floquet[j], 2e-4) << law << ", point " << i << ", " << j;
      }
    }
  }
}

// The dimension by its definition, from the exponents that came with it.
TEST(Lyapunov, KaplanYorkeFollowsFromTheSpectrum) {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
          "values = [0.65, 1.3, 1.35, 1.4, 1.7]\n[integrate]\nsettle = 100\nrecord = 100\n" +
          kObserveExponents);
  const std::vector<double>& dimensions = map_of(result, "kaplan_yorke");
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    std::vector<double> exponents = spectrum_of(result, i);
    std::sort(exponents.begin(), exponents.end(), std::greater<>());
    std::vector<double> sums(exponents.size());
    std::partial_sum(exponents.begin(), exponents.end(), sums.begin());
    const auto negative =
        std::find_if(sums.begin(), sums.end(), [](double value) { return value < 0.0; });
    const auto j = static_cast<std::size_t>(negative - sums.begin());
    ASSERT_LT(j, sums.size());
    const double expected =
        j == 0 ? 0.0 : static_cast<double>(j) + sums[j - 1] / std::abs(exponents[j]);
    // The same few operations in another order.
    EXPECT_NEAR(dimensions[i], expected, 1e-12) << "point " << i;
  }
  EXPECT_EQ(dimensions[0], 0.0);  // a stable orbit
  EXPECT_THAT(std::vector<double>(dimensions.begin() + 1, dimensions.end()),
              Each(AllOf(Gt(1.0), Lt(10.0))));
}

// No impact to chaos, several phase grids whose sizes are no multiple of any number of lanes.
TEST(Lyapunov, DoesNotDependOnHowTheWorkIsCutUp) {
  const std::string toml =
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[[axes]]\nname = 'omega'\n"
      "from = 0.4\nto = 1.8\ncount = 45\n[integrate]\nsettle = 12\nwarm_up = 7\n"
      "record = 11\n" +
      kObserveExponents;
  const SweepResult expected = run(toml);
  for (const char* cut : {"integrate.tile=10", "integrate.round=1", "integrate.round=5"}) {
    const SweepResult result = run(toml, {cut});
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U)
          << cut << ", " << result.study.selection.quantities[i].name;
    }
  }
  // A device may have another logarithm for vectors of another length, whose last bit may differ;
  // nothing is computed from it but sums of a few terms and, for the dimension, one quotient.
  const SweepResult scalar = run(toml, {"integrate.lanes=1"});
  for (std::size_t i = 0; i < scalar.values.size(); ++i) {
    for (std::size_t k = 0; k < scalar.values[i].size(); ++k) {
      EXPECT_NEAR(scalar.values[i][k], expected.values[i][k], 1e-14)
          << scalar.study.selection.quantities[i].name << ", number " << k;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
