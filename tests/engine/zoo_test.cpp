// Models of the zoo, but for gears, against answers that take code: exact orbits, Hill's method,
// limits. Those that are numbers stand in the models' files (zoo/).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/hill.hpp"
#include "engine/zoo_answers.hpp"

namespace gearsweep::testing {
namespace {

// ---- all of them --------------------------------------------------------------------------------

// Anywhere in the ranges of its parameters, at states of a few units, a model has finite slopes,
// and so has the middle, where a radius is 0.
TEST(Zoo, SlopesAreFiniteWhateverTheParameters) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const char* name : {"blankenship_kahraman", "bouncing_ball", "chua", "den_hartog",
                           "duffing_pair", "gear_friction", "hertz", "idler", "jeffcott_rub",
                           "shaken_pendulum", "shaw_holmes", "two_flanks"}) {
    const Model& model = *find_model(name);
    const std::size_t n = model.states.size();
    std::vector<double> coefs(model.phase_coefs.size()), slope(n), jacobian(n * n);
    std::vector<double> signals(model.signals.size());
    for (int trial = 0; trial < 300; ++trial) {
      ModelSetting setting = model.default_setting();
      for (std::size_t i = 0; i < setting.parameters.size(); ++i) {
        const ParameterInfo& parameter = model.parameters[i];
        setting.parameters[i] =
            parameter.min + share(random) * share(random) * (parameter.max - parameter.min);
      }
      const double psi = share(random);
      model.phase_coefs_at(setting, psi, psi, coefs.data());
      std::vector<double> state = model.equilibrium(setting);
      for (double& value : state) {
        EXPECT_TRUE(std::isfinite(value)) << name;
        value = trial == 0 ? 0.0 : 6.0 * share(random) - 3.0;
      }
      const auto point = model.prepare(setting);
      point->rhs(coefs.data(), state.data(), slope.data());
      point->jacobian(coefs.data(), state.data(), jacobian.data());
      point->signals(coefs.data(), state.data(), signals.data());
      for (const auto* values : {&slope, &jacobian, &signals}) {
        for (const double value : *values) EXPECT_TRUE(std::isfinite(value)) << name;
      }
    }
  }
}

// ---- shaw_holmes -------------------------------------------------------------------------------

// 1024 steps of 0.004 and a frequency of 8 on the stop: (h w)^4/120 is 1e-8 for each unit of phase
// on the stop, of which some periods add up before the damping takes them.
TEST(ZooShawHolmes, OrbitWithImpactsIsTheExactOne) {
  const double omega = 1.55, k = 64.0, b = 0.2, F = 1.0, zeta = 0.05;
  ExactPieces exact = {.omega = omega, .limits = {{vector_of({1.0, 0.0}), b}}, .field = {}};
  exact.field = [&](const Sides& beyond, std::size_t) {
    LinearField field(2);
    const double stop = beyond[0] ? k : 0.0;
    field.slope << 0.0, 1.0, -1.0 - stop, -2.0 * zeta;
    field.constant[1] = stop * b;
    field.cosine[1] = F;
    return field;
  };
  const Example example("shaw_holmes", {{"omega", omega}, {"k", k}, {"b", b}});
  expect_orbit(example, exact, 2, 5e-8);
}

// The linear motion touches the stop where its amplitude F/|1 - w^2 + 2 i zeta w| is the gap.
TEST(ZooShawHolmes, GrazesWhereTheLinearAmplitudeIsTheGap) {
  const double omega = 2.6, b = 0.2, zeta = 0.05;
  const std::complex<double> flexibility =
      1.0 / std::complex<double>(1.0 - omega * omega, 2.0 * zeta * omega);
  for (const double part : {0.99, 1.0 - 1e-6}) {
    const double F = part * b / std::abs(flexibility);
    const std::complex<double> swing = F * flexibility;
    const Example example("shaw_holmes", {{"omega", omega}, {"k", 64.0}, {"b", b}, {"F", F}});
    const Orbit orbit =
        shoot(example.map(), vector_of({swing.real(), -omega * swing.imag()}), 1).value();
    // (h w)^4/120 of the amplitude.
    double nearest = b;
    for (const Graze& graze : orbit.grazes) nearest = std::min(nearest, std::fabs(graze.distance));
    EXPECT_NEAR(nearest, (1.0 - part) * b, 1e-10);
  }
}

// ---- bouncing_ball -----------------------------------------------------------------------------

// What the surface gives back of a speed: the root r of a v (1 + r) = log((1 + a v)/(1 - a v r)).
double restitution(double a, double speed) {
  const double u = a * speed;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double r = 0.5 * (low + high);
    // The right side grows from below the left one; it has a pole where u r is 1.
    const bool beyond = u * r >= 1.0 || std::log((1.0 + u) / (1.0 - u * r)) > u * (1.0 + r);
    (beyond ? high : low) = r;
  }
  return low;
}

// On a rigid table (Holmes) a ball that bounces once in a period T leaves with the speed g T/2 and
// comes back with it: the table rises with V = U (1 - r)/(1 + r), U = g T/2, at the impact, with
// the r of the speed 2 U/(1 + r). That gives the phase, A w cos(phase) = V, and the ball's greatest
// height. A surface of stiffness k differs by the time of a contact, a multiple of 1/sqrt(k), so
// that k and 4 k tell the limit up to a multiple of 1/k.
TEST(ZooBouncingBall, TendsToTheBounceOnARigidTable) {
  const double A = 1.2, a = 0.3, U = std::numbers::pi;
  double r = 0.5;
  for (int i = 0; i < 200; ++i) r = restitution(a, 2.0 * U / (1.0 + r));
  const double V = U * (1.0 - r) / (1.0 + r);
  const double rigid = A * std::sqrt(1.0 - V * V / (A * A)) + 0.5 * U * U;
  std::vector<double> heights;
  for (const double k : {1e4, 4e4}) {
    const Points points = {.model = "bouncing_ball",
                           .parameters = "omega = 1.0\nk = " + digits(k),
                           .axis = "name = 'v'\nvalues = [3.1]",
                           .start = "policy = 'fixed'\nstate = {z = 1.0}",
                           .quantities = "'z_max', 'period'",
                           .settle = 100,
                           .record = 8,
                           .steps = 8192};
    const SweepResult result = points.run();
    EXPECT_EQ(map_of(result, "period")[0], 1.0);
    heights.push_back(map_of(result, "z_max")[0]);
  }
  EXPECT_NEAR(2.0 * heights[1] - heights[0], rigid, 5e-4) << heights[0] << ' ' << heights[1];
}

// ---- chua --------------------------------------------------------------------------------------

// The divergence is -alpha (1 + m0) - 1 between the corners and -alpha (1 + m1) - 1 beyond them, so
// the sum of the exponents tells the share of the time in between.
TEST(ZooChua, ExponentsAddUpByTheTimeBetweenTheCorners) {
  // With a clock, so that shares of time count all of it alike, as the exponents do.
  const SweepResult result = run(
      "[model]\ntext = '''" + find_model("chua")->text + "[forcing]\nperiod = 1.0\n'''\n" +
      "[[axes]]\nname = 'x'\nfrom = 0.0\nto = 0.007\ncount = 8\n[initial]\npolicy = 'fixed'\n"
      "state = {z = 0.6}\n[integrate]\nsettle = 100\nrecord = 1000\nsteps_per_period = 50\n"
      "extend = 1\nstop = 'never'\n[observe]\nquantities = ['lyapunov_spectrum', 'contact_gap']\n");
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  for (std::size_t i = 0; i < 8; ++i) {
    const double sum = spectrum[3 * i] + spectrum[3 * i + 1] + spectrum[3 * i + 2];
    const double inside = map_of(result, "contact_gap")[i];
    const double m0 = -8.0 / 7.0, m1 = -5.0 / 7.0;
    // Steps of 0.02, and shares that follow the motion inside them by a cubic.
    EXPECT_NEAR(sum, -1.0 - 9.0 * (1.0 + inside * m0 + (1.0 - inside) * m1), 1e-4);
  }
}

// At the equilibria of the scrolls the characteristic polynomial is
// l^3 + (1 + alpha c) l^2 + (alpha c - alpha + beta) l + alpha beta c with c = 1 + m1. Two roots
// are imaginary where alpha^2 c (1 - c) + alpha (1 - c) = beta: the Hopf bifurcation.
TEST(ZooChua, ScrollsAreBornAtTheHopfBifurcation) {
  const double c = 2.0 / 7.0, beta = 100.0 / 7.0;
  const double half = 0.5 / c;
  const double alpha = -half + std::sqrt(half * half + beta / (c * (1.0 - c)));
  const auto growth = [&](double at) {
    const Example example("chua", {{"alpha", at}});
    const std::vector<double> rest = example.model->equilibrium(example.setting);
    EXPECT_NEAR(rest[0], 1.5, 1e-14);
    const Eigen::VectorXd state = vector_of({rest[0], rest[1], rest[2]});
    return std::log(std::abs(
        make_orbit(state, example.map(256).linearize(state, 1).value(), 1).multipliers[0]));
  };
  // (h w)^4/120 with w = 2.8 and h = 1/256.
  EXPECT_NEAR(growth(alpha), 0.0, 1e-9);
  EXPECT_LT(growth(0.999 * alpha), -1e-5);
  EXPECT_GT(growth(1.001 * alpha), 1e-5);
}

// ---- shaken_pendulum ---------------------------------------------------------------------------

// Characteristic values of Mathieu's equation for q = 1 (Abramowitz and Stegun, Handbook of
// Mathematical Functions, 1964, chapter 20): a0 = -0.4551386041, b1 = -0.1102488170,
// a1 = 1.8591080725. There rest has a multiplier of 1 (a0) or -1. Between a0 and b1 the shaken
// pendulum stands, below it falls, between b1 and a1 it swings.
TEST(ZooShakenPendulum, ItsBordersAreMathieusCharacteristicValues) {
  const double omega = 1.8;
  const auto trace = [&](double a) {
    const Example example("shaken_pendulum", {{"omega", omega},
                                              {"amplitude", 0.5},
                                              {"damping", 0.0},
                                              {"gravity", 0.25 * a * omega * omega}});
    return example.map(1024).linearize(Eigen::VectorXd::Zero(2), 1).value().monodromy.trace();
  };
  // The trace changes by up to 10 for a change of 1 in a, of which ten digits are published.
  EXPECT_NEAR(trace(-0.4551386041), 2.0, 2e-9);
  EXPECT_NEAR(trace(-0.1102488170), -2.0, 2e-9);
  EXPECT_NEAR(trace(1.8591080725), -2.0, 2e-9);
}

// Falling, standing, and in the first tongue.
TEST(ZooShakenPendulum, ExponentsOfItsRestAreHills) {
  const double omega = 1.8, damping = 0.1;
  for (const double gravity : {-0.6, -0.25, 0.9}) {
    const Hill hill = {
        .damping = damping, .mean = gravity, .kappa = 0.5 * omega * omega, .omega = omega};
    const Example example("shaken_pendulum",
                          {{"omega", omega}, {"amplitude", 0.5}, {"gravity", gravity}});
    const Orbit rest = shoot(example.map(), Eigen::VectorXd::Zero(2), 1).value();
    // (h w)^4/120 of 1024 steps.
    EXPECT_NEAR(std::log(std::abs(rest.multipliers[0])) * omega / (2.0 * std::numbers::pi),
                hill.exponent(), 1e-10);
    EXPECT_EQ(rest.stable(), gravity == -0.25);
  }
}

// ---- den_hartog --------------------------------------------------------------------------------

// While x falls, x = V cos(w t + psi) + f (1 - cos t) + w q sin t with V = 1/(1 - w^2) and the
// friction f; half a period later it is -x. Velocities of 0 at both ends give
// w q = -f sin(pi/w)/(1 + cos(pi/w)) and V sin(psi) = q: the amplitude is V cos(psi) =
// sqrt(V^2 - q^2), which is Den Hartog's. The softened sign has an error of soft^2, with a factor
// of the order of 1.
TEST(ZooDenHartog, MotionThatNeverSticksIsDenHartogs) {
  for (const double w : {0.7, 1.3}) {
    const double f = 0.3, V = 1.0 / (1.0 - w * w), half = std::numbers::pi / w;
    const double q = -f * std::sin(half) / (w * (1.0 + std::cos(half)));
    double psi = std::asin(q / V);
    if (V < 0.0) psi = std::numbers::pi - psi;  // the amplitude is positive
    // At phase pi or 0, whichever lies in the half period: minus the state at phase 0, or that.
    double phase = std::numbers::pi;
    while (phase - psi > std::numbers::pi) phase -= std::numbers::pi;
    while (phase - psi < 0.0) phase += std::numbers::pi;
    const double t = (phase - psi) / w, sign = std::cos(phase);
    const Eigen::VectorXd exact =
        vector_of({sign * (sign * V + f * (1.0 - std::cos(t)) + w * q * std::sin(t)),
                   sign * (f * std::sin(t) + w * q * std::cos(t))});
    const auto found = [&](double soft) {
      const Example example("den_hartog",
                            {{"omega", w}, {"friction", f}, {"zeta", 0.0}, {"soft", soft}});
      return example.orbit(100, 2048).state;
    };
    const double soft = 0.01;
    const Eigen::VectorXd limit = 2.0 * found(0.5 * soft) - found(soft);
    EXPECT_LT((limit - exact).cwiseAbs().maxCoeff(), soft * soft) << w;
  }
}

}  // namespace
}  // namespace gearsweep::testing
