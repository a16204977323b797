// What the solutions of gear5 must be, exactly, in special cases and under symmetries.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>

#include "engine/outside_gear5.hpp"
#include "plan/plan.hpp"
#include "support/eigenvalues.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

const std::string kConstantStiffness = "stiffness = 'fourier'\n[parameters]\nkappa = 0.0\n";

// With mean stiffness 1 and no friction or forcing, any start in contact ends in the static
// solution. 400 periods of damping leave nothing, so what remains is rounding.
TEST(Exact, StaticSolution) {
  const double F1 = 0.1, b = 0.8, k2 = 1.2, k4 = 1.9;
  const SweepResult result =
      run("[model]\n" + kConstantStiffness +
          "mu = 0.0\ne0 = 0.0\nk1 = 1.0\nk2 = 1.2\nk3 = 1.5\nk4 = 1.9\n[initial]\n"
          "policy = 'fixed'\nstate = {x1 = 1.1, x2 = 0.01, x3 = 0.02, x4 = -0.01, x5 = 0.03}\n"
          "[[axes]]\nname = 'b'\nvalues = [0.8]\n[integrate]\nsettle = 400\nrecord = 1\nstop = "
          "'never'\n" +
          kObserveGear5);
  const double expected[10] = {b + F1 * (1.0 + 1.0 / k2 + 1.0 / k4), 0.0, F1 / k2, 0.0, -F1 / k4};
  for (std::size_t state = 0; state < 10; ++state) {
    EXPECT_NEAR(samples_of(result, 0, state)[0], expected[state], 1e-14) << "state " << state;
  }
}

// m k is the square of a shaft's own frequency K; the mesh couples torsion and the two shafts'
// difference to the roots L of L^2 - (1 + K + 2 m) L + K = 0.
struct Frequencies {
  double m = 0.3507525, k = 1.38;
  double shaft = std::sqrt(m * k);
  double low, high;
  Frequencies() {
    const double K = m * k;
    const double half = 0.5 * (1.0 + K + 2.0 * m);
    const double root = std::sqrt(half * half - K);
    high = std::sqrt(half + root);
    low = std::sqrt(K) / high;  // the product of the squares is K; no cancellation
  }
};

ModelSetting undamped_contact() {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "stiffness", "fourier");
  for (const char* name : {"kappa", "zeta", "mu", "e0"}) set_parameter(&setting, name, 0.0);
  return setting;
}

// In contact the right-hand side is affine, so central differences are exact but for rounding
// (1e-16 over a step of 1e-2); the eigenvalue solver adds 1e-14. The triple root sqrt(K) is
// semisimple, since the shafts' motions do not couple.
TEST(Exact, NaturalFrequenciesOfTheField) {
  const ModelSetting setting = undamped_contact();
  const std::unique_ptr<PreparedPoint> point = gear5().prepare(setting);
  std::vector<double> coefs(gear5().phase_coefs.size());
  gear5().phase_coefs_at(setting, 0.3, 0.3, coefs.data());
  const std::vector<double> rest = gear5().equilibrium(setting);
  Eigen::MatrixXd jacobian(10, 10);
  for (Eigen::Index column = 0; column < 10; ++column) {
    std::vector<double> up = rest, down = rest;
    up[static_cast<std::size_t>(column)] += 0.01;
    down[static_cast<std::size_t>(column)] -= 0.01;
    Eigen::VectorXd slope_up(10), slope_down(10);
    point->rhs(coefs.data(), up.data(), slope_up.data());
    point->rhs(coefs.data(), down.data(), slope_down.data());
    jacobian.col(column) = (slope_up - slope_down) / 0.02;
  }
  const Eigen::VectorXcd roots = eigenvalues_of(jacobian);
  std::vector<double> found;
  for (const std::complex<double>& root : roots) {
    EXPECT_NEAR(root.real(), 0.0, 1e-12);
    if (root.imag() > 0.0) found.push_back(root.imag());
  }
  std::sort(found.begin(), found.end());
  const Frequencies exact;
  const std::vector<double> expected = {exact.low, exact.shaft, exact.shaft, exact.shaft,
                                        exact.high};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
  EXPECT_NEAR(found[0], 0.500, 5e-4);
  EXPECT_NEAR(found[1], 0.696, 5e-4);
  EXPECT_NEAR(found[4], 1.391, 5e-4);
}

// Started in a mode, the kernel comes back to where it started after each period of that mode. One
// step's phase error is (2 pi / 1024)^5/120 = 7e-14, so ten periods leave 7e-10 of the amplitude
// 0.05.
TEST(Exact, NaturalFrequenciesOfTheKernel) {
  const Frequencies exact;
  struct Mode {
    double frequency, x1, x2, x3, x4, x5;
  };
  const auto coupled = [](double w) {  // torsion a, x3 - x5 = (1 - w^2) a
    const double half = 0.5 * (1.0 - w * w);
    return Mode{w, 1.0, 0.0, half, 0.0, -half};
  };
  for (const Mode& mode :
       {coupled(exact.low), coupled(exact.high), Mode{exact.shaft, 0.0, 1.0, 0.0, 0.0, 0.0},
        Mode{exact.shaft, 0.0, 0.0, 0.0, 1.0, 0.0}, Mode{exact.shaft, 0.0, 0.0, 1.0, 0.0, 1.0}}) {
    std::vector<double> start = gear5().equilibrium(undamped_contact());
    const double shape[5] = {mode.x1, mode.x2, mode.x3, mode.x4, mode.x5};
    for (std::size_t i = 0; i < 5; ++i) start[i] += 0.05 * shape[i];
    const SweepResult result =
        run("[model]\n" + kConstantStiffness + "zeta = 0.0\nmu = 0.0\ne0 = 0.0\n[initial]\n" +
            fmt::format("policy = 'fixed'\nstate = {{x1 = {}, x2 = {}, x3 = {}, x4 = {}, x5 = {}}}",
                        digits(start[0]), digits(start[1]), digits(start[2]), digits(start[3]),
                        digits(start[4])) +
            "\n[[axes]]\nname = 'omega'\nvalues = [" + digits(mode.frequency) +
            "]\n[integrate]\nsteps_per_period = 1024\nsettle = 9\nrecord = 1\n" + kObserveGear5);
    ASSERT_EQ(map_of(result, "contact_gap")[0], 0.0);
    for (std::size_t state = 0; state < 10; ++state) {
      EXPECT_NEAR(samples_of(result, 0, state)[0], start[state], 1e-10)
          << "state " << state << ", frequency " << mode.frequency;
    }
  }
}

// Nothing pushes the shafts across the line of action when there is no friction: not even rounding.
TEST(Exact, WithoutFrictionTheCrossMotionStaysZero) {
  const SweepResult result =
      run("[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nmu = 0.0\n"
          "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.8\ncount = 15\n"
          "[integrate]\nsettle = 50\nrecord = 50\nstop = 'never'\n[observe]\nquantities = "
          "['contact_class', "
          "'x2_min', 'x2_max', 'x4_min', 'x4_max', 'v2_min', 'v2_max', 'v4_min', 'v4_max']\n");
  for (const char* quantity :
       {"x2_min", "x2_max", "x4_min", "x4_max", "v2_min", "v2_max", "v4_min", "v4_max"}) {
    for (const double value : map_of(result, quantity)) EXPECT_EQ(value, 0.0) << quantity;
  }
  const std::vector<double>& classes = map_of(result, "contact_class");
  EXPECT_EQ(*std::max_element(classes.begin(), classes.end()), 2.0);
}

// Equal gears push their shafts with equal and opposite forces, so sums of the shafts' positions
// obey s'' + 2 a s' + m k s = 0 with a = m c zeta, whatever the mesh does. The steps' phase error
// is (0.7 * 0.009)^4/120 = 1e-11 per radian: 1e-9 after 10 periods of 9 units of time.
TEST(Exact, SumsOfTheShaftsAreFreeOscillators) {
  const double m = 0.3507525, k = 1.38, c = 2.0, zeta = 0.04008, omega = 0.7;
  const SweepResult result =
      run("[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nmu = 0.2\n"
          "[[axes]]\nname = 'omega'\nvalues = [0.7]\n[initial]\npolicy = 'fixed'\n"
          "state = {x1 = 1.0, x2 = 0.3, x4 = 0.2, v2 = 0.1, v4 = -0.3, x3 = 0.3, x5 = -0.1, "
          "v3 = 0.2, v5 = 0.1}\n[integrate]\nsteps_per_period = 1024\nsettle = 0\nrecord = 10\n" +
          kObserveGear5);
  ASSERT_GT(map_of(result, "contact_losses")[0], 0.0);
  const double a = m * c * zeta;
  const double w = std::sqrt(m * k - a * a);
  const auto free = [&](double t, double s, double v) {
    return std::exp(-a * t) * (s * std::cos(w * t) + (v + a * s) / w * std::sin(w * t));
  };
  for (std::size_t i = 0; i < 10; ++i) {
    const double t = static_cast<double>(i + 1) * 2.0 * std::numbers::pi / omega;
    const auto sum = [&](std::size_t one, std::size_t other) {
      return samples_of(result, 0, one)[i] + samples_of(result, 0, other)[i];
    };
    EXPECT_NEAR(sum(1, 3), free(t, 0.5, -0.2), 1e-9) << "period " << i;
    EXPECT_NEAR(sum(2, 4), free(t, 0.2, 0.3), 1e-9) << "period " << i;
  }
}

// While the back flank is not touched, nothing but x1 knows b. The states differ in rounding only,
// and the motions are stable: 1e-13 is ample.
void expect_translation(const std::string& model, const std::string& omega, double min_class) {
  const SweepResult result =
      run(model +
          "[[axes]]\nname = 'b'\nvalues = [0.375, 0.4, 1.0, 1.7]\n[[axes]]\n"
          "name = 'omega'\nvalues = " +
          omega +
          "\n[initial]\npolicy = 'shifted'\n[integrate]\n"
          "steps_per_period = 512\nsettle = 200\nrecord = 2\nstop = 'never'\n" +
          kObserveGear5);
  const std::vector<double>& b = result.study.axes[0].values;
  for (std::size_t point = 0; point < result.study.points(); ++point) {
    const std::size_t first = point / b.size() * b.size();  // the smallest b at the same omega
    const double shift = b[point % b.size()] - b[0];
    ASSERT_EQ(map_of(result, "contact_back")[point], 0.0);
    ASSERT_EQ(map_of(result, "contact_class")[point], min_class);
    EXPECT_NEAR(map_of(result, "x1_mean")[point], map_of(result, "x1_mean")[first] + shift, 1e-13);
    for (const char* quantity : {"x1_std", "dmf_min", "dmf_max", "contact_drive"}) {
      EXPECT_NEAR(map_of(result, quantity)[point], map_of(result, quantity)[first], 1e-13)
          << quantity;
    }
    for (std::size_t state = 0; state < 10; ++state) {
      EXPECT_NEAR(samples_of(result, point, state)[1],
                  samples_of(result, first, state)[1] + (state == 0 ? shift : 0.0), 1e-13);
    }
  }
}

TEST(Exact, TranslationInTheBacklash) {
  expect_translation("[model]\npreset = 'consistent'\n", "[0.5, 1.0]", 1.0);
}

TEST(Exact, TranslationInTheDynamicBacklash) {
  expect_translation("[model]\npreset = 'consistent'\nbacklash = 'dynamic'\n", "[0.5, 1.0]", 1.0);
}

TEST(Exact, TranslationInTheBacklashAsPrinted) {
  expect_translation("[model]\npreset = 'paper'\n", "[0.3, 0.5]", 0.0);
}

// Without mass ratio the shafts stand still, and x1 is a one-degree-of-freedom gear pair with
// damping ratio z = 2 zeta, here integrated by odeint from its own equation. The kernel's steps
// over impacts leave 1e-7; m = 1e-12 moves the shafts by at most m f t^2/2 = 1e-7.
TEST(Exact, WithoutMassRatioItIsTheOneDegreeOfFreedomPair) {
  const SweepResult result =
      run("[model]\npreset = 'consistent'\n[parameters]\nmu = 0.0\nomega = 0.9\n[[axes]]\n"
          "name = 'm1'\nvalues = [0.0, 1e-12]\n[[axes]]\nname = 'm2'\nvalues = [0.0, 1e-12]\n"
          "[initial]\npolicy = 'fixed'\nstate = {x1 = 1.1}\n[integrate]\nsettle = 59\n"
          "record = 1\nsteps_per_period = 4096\nstop = 'never'\n" +
          kObserveGear5);
  using Pair = std::array<double, 2>;
  const OutsideGear gear(result.study.setting);
  const double omega = 0.9, F1 = 0.1, e0 = 0.2, z = 2.0 * 0.04008, eps = 1.718;
  Pair x = {1.1, 0.0};
  for (int period = 0; period < 60; ++period) {
    for (const auto& [from, to] : {Pair{0.0, eps - 1.0}, Pair{eps - 1.0, 1.0}}) {
      const auto slope = [&, inside = 0.5 * (from + to)](const Pair& at, Pair& d, double psi) {
        const double T = gear.period();
        const double f = at[0] > 1.0 ? at[0] - 1.0 : std::min(0.0, at[0] + 1.0);
        d[0] = T * at[1];
        d[1] = T * (F1 + e0 * omega * omega * std::sin(2.0 * std::numbers::pi * psi) -
                    gear.sums(psi, inside).B * f - 2.0 * z * at[1]);
      };
      namespace odeint = boost::numeric::odeint;
      odeint::integrate_adaptive(
          odeint::make_controlled(1e-12, 1e-12, odeint::runge_kutta_dopri5<Pair>()), slope, x, from,
          to, 1e-3);
    }
  }
  ASSERT_GT(map_of(result, "contact_class")[0], 0.0);
  for (std::size_t point = 0; point < result.study.points(); ++point) {
    EXPECT_NEAR(samples_of(result, point, 0)[0], x[0], 1e-6);
    EXPECT_NEAR(samples_of(result, point, 5)[0], x[1], 1e-6);
  }
}

}  // namespace
}  // namespace gearsweep::testing
