// Lyapunov exponents against what is known exactly (their sum, Floquet multipliers), against the
// growth of a small difference, and against the reference engine, which has its own way to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "reference/trajectory.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Gt;
using ::testing::Le;
using ::testing::Lt;

const std::string kObserveAll =
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

// The mean trace of gear5's Jacobian: the exact sum of all exponents, for equal gears.
double exact_sum(const ModelSetting& setting) {
  const auto p = [&](const char* name) { return parameter_of(setting, name); };
  const bool printed = option_of(setting, "formulation") == "printed";
  // The arms of the friction in the torsional equation: with `consistent` approach and recess
  // cancel, with `printed` they change along the path of contact.
  double mean_g = 2.0;
  if (printed) {
    mean_g -= p("mu") * 2.0 * std::numbers::pi / p("zp") * p("eps") * p("eps") / 4.0;
  }
  const double bearings = p("m1") * (p("c1") + p("c2")) + p("m2") * (p("c3") + p("c4"));
  const double shafts = (printed ? -1.0 : 1.0) * 2.0 * (p("m1") + p("m2"));
  return -2.0 * p("zeta") * (mean_g + bearings + shafts);
}

void expect_exact_sums(const std::string& model, const std::string& parameters) {
  const SweepResult result = run(
      "[model]\npreset = 'coarse'\n" + model + "[parameters]\n" + parameters +
      "[[axes]]\nname = 'mu'\nvalues = [0.0, 0.05, 0.2]\n[[axes]]\nname = 'eps'\n"
      "values = [1.2, 1.5, 1.718, 1.95]\n[integrate]\nmax_step = 0.02\nsettle = 20\nrecord = 40\n" +
      kObserveAll);
  EXPECT_THAT(result.status, Each(0));
  EXPECT_THAT(map_of(result, "contact_class"), Contains(Ge(1.0)));
  const Plan plan(result.study, 256);
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const double exact = exact_sum(plan.setting_of(point));
    EXPECT_NEAR(sum(spectrum_of(result, point)), exact, 3e-6) << "point " << point;
    std::printf("DBG %zu %.3g\n", point, sum(spectrum_of(result, point)) - exact);
  }
}

TEST(LyapunovSum, ConsistentConstantBacklash) {
  expect_exact_sums("backlash = 'constant'\n", "omega = 1.35\n");
}
TEST(LyapunovSum, ConsistentDynamicBacklash) {
  expect_exact_sums("backlash = 'dynamic'\n", "omega = 1.35\n");
}
TEST(LyapunovSum, ConsistentUnequalMasses) {
  expect_exact_sums("backlash = 'dynamic'\n", "omega = 1.1\nm2 = 0.2\nc3 = 1.0\nc4 = 3.0\n");
}
TEST(LyapunovSum, PrintedConstantBacklash) {
  expect_exact_sums("backlash = 'constant'\nformulation = 'printed'\n",
                    "omega = 1.0\nm1 = 0.04\nm2 = 0.04\n");
}
TEST(LyapunovSum, PrintedDynamicBacklash) {
  expect_exact_sums("backlash = 'dynamic'\nformulation = 'printed'\n",
                    "omega = 1.0\nm1 = 0.04\nm2 = 0.04\n");
}

void expect_engines_agree(const std::string& toml, double tolerance) {
  const SweepResult kernel = run(toml + kObserveAll);
  const SweepResult reference = run(toml + kObserveAll, {"integrate.engine='reference'"});
  EXPECT_THAT(kernel.status, Each(0));
  EXPECT_THAT(reference.status, Each(0));
  for (const Quantity& quantity : kernel.study.selection.quantities) {
    const std::vector<double>& a = map_of(kernel, quantity.name);
    const std::vector<double>& b = map_of(reference, quantity.name);
    ASSERT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i], b[i], tolerance) << quantity.name << ", number " << i;
      worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    std::printf("DBG %s %.3g\n", quantity.name.c_str(), worst);
  }
}

// Orbits without impact and with it; both backlash laws.
TEST(LyapunovEngines, AgreeOnRegularOrbits) {
  for (const std::string law : {"constant", "dynamic"}) {
    expect_engines_agree("[model]\npreset = 'coarse'\nbacklash = '" + law +
                             "'\n[[axes]]\nname = 'omega'\nvalues = [0.25, 0.65, 0.8, 1.0]\n"
                             "[integrate]\nsettle = 60\nrecord = 40\n",
                         1e-9);
  }
}

TEST(LyapunovEngines, AgreeOnChaosForSomePeriods) {
  for (const std::string law : {"constant", "dynamic"}) {
    expect_engines_agree("[model]\npreset = 'coarse'\nbacklash = '" + law +
                             "'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
                             "values = [1.3, 1.35, 1.4, 1.7]\n[integrate]\nsettle = 10\n"
                             "record = 17\n",
                         1e-9);
  }
}

const std::string kChaos =
    "[model]\npreset = 'coarse'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
    "values = [1.3, 1.35, 1.4, 1.7]\n";

TEST(LyapunovFp32, ChaosHasTheExponentOfFp64) {
  const std::string toml = kChaos + "[integrate]\nsettle = 400\nrecord = 3200\n" + kObserveAll;
  const SweepResult exact = run(toml);
  const SweepResult single = run(toml, {"integrate.precision=fp32"});
  for (std::size_t i = 0; i < exact.status.size(); ++i) {
    const double error =
        std::hypot(map_of(exact, "lyapunov_max_error")[i], map_of(single, "lyapunov_max_error")[i]);
    std::printf("DBG %g %g +- %g\n", map_of(exact, "lyapunov_max")[i],
                map_of(single, "lyapunov_max")[i], error);
    EXPECT_GT(map_of(exact, "lyapunov_max")[i], 0.02);
    EXPECT_LT(error, 0.002);
    EXPECT_NEAR(map_of(single, "lyapunov_max")[i], map_of(exact, "lyapunov_max")[i], 4.0 * error);
    EXPECT_NEAR(sum(spectrum_of(single, i)), sum(spectrum_of(exact, i)), 1e-4);
    std::printf("DBG sums %.8g %.8g\n", sum(spectrum_of(single, i)), sum(spectrum_of(exact, i)));
  }
}

TEST(LyapunovFp32, LongPeriodsNeitherOverflowNorVanish) {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.005, 0.02, 0.1]\n"
          "[integrate]\nprecision = 'fp32'\nsettle = 2\nrecord = 8\n" +
          kObserveAll);
  const Plan plan(result.study, 256);
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    std::printf("DBG %g %g\n", map_of(result, "lyapunov_max")[i],
                sum(spectrum_of(result, i)) - exact_sum(plan.setting_of(i)));
    for (double e : spectrum_of(result, i)) std::printf(" %g", e);
    std::printf("\n");
    EXPECT_NEAR(sum(spectrum_of(result, i)), exact_sum(plan.setting_of(i)), 1e-4);
  }
}

TEST(Lyapunov, IsTheGrowthOfASmallDifference) {
  constexpr std::size_t kAlign = 60, kRecord = 40;
  const std::string start = digits(std::vector<double>{1.2, 1.2 + 1e-9});
  const std::string common = kChaos + "[[axes]]\nname = 'x1'\nvalues = " + start +
                             "\n[initial]\npolicy = 'fixed'\nstate = {x3 = 0.1}\n[integrate]\n";
  const SweepResult tangent = run(
      common + "settle = 60\nrecord = 40\n[observe]\nquantities = ['lyapunov_max_per_period']\n");
  const SweepResult states =
      run(common +
          "settle = 59\nrecord = 41\n[observe]\nquantities = ['poincare']\n"
          "poincare = ['x1', 'x2', 'x3', 'x4', 'x5', 'v1', 'v2', 'v3', 'v4', 'v5']\n");
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
    std::printf("DBG %g %g d %g %g\n", growth, expected, distance(0), distance(kRecord));
    EXPECT_GT(expected, 2.0);
    EXPECT_NEAR(growth, expected, 0.02);
  }
  static_cast<void>(kAlign);
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
  for (const std::complex<double>& multiplier : monodromy.eigenvalues()) {
    exponents.push_back(std::log(std::abs(multiplier)) / orbit.period());
  }
  std::sort(exponents.begin(), exponents.end(), std::greater<>());
  return exponents;
}

TEST(Lyapunov, IsTheFloquetExponentOfAPeriodicOrbit) {
  for (const std::string law : {"constant", "dynamic"}) {
    const SweepResult result =
        run("[model]\npreset = 'coarse'\nbacklash = '" + law +
            "'\n[[axes]]\nname = 'omega'\nvalues = [0.65, 0.8, 1.0]\n[integrate]\nsettle = 600\n"
            "record = 4000\n" +
            kObserveAll);
    EXPECT_THAT(map_of(result, "contact_class"), Contains(Ge(1.0)));
    const Plan plan(result.study, 256);
    for (std::size_t i = 0; i < result.status.size(); ++i) {
      std::vector<double> exponents = spectrum_of(result, i);
      std::sort(exponents.begin(), exponents.end(), std::greater<>());
      const std::vector<double> floquet = floquet_exponents(plan, i);
      double worst = 0;
      for (std::size_t j = 0; j < exponents.size(); ++j) {
        EXPECT_NEAR(exponents[j], floquet[j], 2e-4) << law << ", point " << i << ", " << j;
        worst = std::max(worst, std::abs(exponents[j] - floquet[j]));
      }
      std::printf("DBG floquet %g worst %g\n", floquet[0], worst);
    }
  }
}

TEST(Lyapunov, KaplanYorkeFollowsFromTheSpectrum) {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\n[parameters]\nb = 1.4\n[[axes]]\nname = 'omega'\n"
          "values = [0.65, 1.3, 1.35, 1.4, 1.7]\n[integrate]\nsettle = 100\nrecord = 100\n" +
          kObserveAll);
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
    std::printf("DBG ky %g\n", dimensions[i]);
  }
  EXPECT_EQ(dimensions[0], 0.0);  // a stable orbit
  EXPECT_THAT(std::vector<double>(dimensions.begin() + 1, dimensions.end()),
              Each(AllOf(Gt(1.0), Lt(10.0))));
}

// No impact to chaos, several phase grids whose sizes are no multiple of any number of lanes.
TEST(Lyapunov, DoesNotDependOnHowTheWorkIsCutUp) {
  for (const std::string law : {"constant", "dynamic"}) {
    const std::string toml =
        "[model]\npreset = 'coarse'\nbacklash = '" + law +
        "'\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.8\ncount = 7\n[[axes]]\nname = 'b'\n"
        "from = 0.3\nto = 1.4\ncount = 5\n[integrate]\nsettle = 12\nwarm_up = 7\nrecord = 11\n"
        "max_step = 0.1\n" +
        kObserveAll;
    const SweepResult expected = run(toml, {"integrate.lanes=1"});
    for (const char* cut : {"integrate.lanes=4", "integrate.lanes=8", "integrate.tile=10",
                            "integrate.local_size=1", "integrate.round=1", "integrate.round=5"}) {
      const SweepResult result = run(toml, {cut});
      for (std::size_t i = 0; i < result.values.size(); ++i) {
        EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U)
            << law << ", " << cut << ", " << result.study.selection.quantities[i].name;
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
