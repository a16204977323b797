// Models of the zoo against answers that take code: exact orbits, Hill's method, limits. Those that
// are numbers stand in the models' files (zoo/).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/exact_pieces.hpp"
#include "orbits/example_orbits.hpp"
#include "support/eigenvalues.hpp"
#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kPi = std::numbers::pi;

// A study of a few points by the device. Without exponents its program takes half the time to
// build.
struct Points {
  std::string model, parameters, axis, start, quantities;
  std::size_t settle = 400, record = 32, steps = 512;

  SweepResult run() const {
    std::string states;
    for (const ChannelInfo& state : find_model(model)->states) states += "'" + state.name + "', ";
    return testing::run(fmt::format(
        "[model]\nname = '{}'\n[parameters]\n{}\n[[axes]]\n{}\n[initial]\n{}\n[integrate]\n"
        "settle = {}\nrecord = {}\nsteps_per_period = {}\nextend = 1\nstop = 'never'\n"
        "[observe]\npoincare = [{}]\nquantities = ['poincare', {}]\n",
        model, parameters, axis, start.empty() ? "policy = 'shifted'" : start, settle, record,
        steps, states, quantities));
  }
};

std::string at_omega(double omega) { return "name = 'omega'\nvalues = [" + digits(omega) + "]"; }

// The orbit that `example` settles on is the exact one, and has its multipliers.
void expect_orbit(const Example& example, const ExactPieces& exact, std::size_t crossings,
                  double tolerance) {
  const Orbit found = shoot(example.map(), example.orbit(150, 256).state, 1).value();
  const ExactPieces::Image orbit = exact.orbit(found.state);
  EXPECT_EQ(orbit.crossings, crossings);
  EXPECT_LT((found.state - orbit.state).cwiseAbs().maxCoeff(), tolerance);
  for (const std::complex<double>& one : eigenvalues_of(orbit.monodromy)) {
    EXPECT_LT((found.multipliers.array() - one).abs().minCoeff(), tolerance) << one;
  }
}

Eigen::VectorXd vector_of(std::initializer_list<double> values) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), out.data());
  return out;
}

// u'' + damping u' + (mean + kappa cos(w t)) u = load by Hill's method: Fourier series of 25
// harmonics, whose coefficients fall faster than factorials.
struct Hill {
  double damping = 0.0, mean = 1.0, kappa = 0.0, omega = 1.0;
  static constexpr int kHarmonics = 12;

  // The coupling of harmonics -12 .. 12 without what the frequency adds.
  Eigen::MatrixXcd stiffness() const {
    const int n = 2 * kHarmonics + 1;
    Eigen::MatrixXcd out = mean * Eigen::MatrixXcd::Identity(n, n);
    for (int i = 0; i + 1 < n; ++i) out(i, i + 1) = out(i + 1, i) = 0.5 * kappa;
    return out;
  }

  // The smallest value of the steady motion.
  double least(double load) const {
    Eigen::MatrixXcd matrix = stiffness();
    for (int n = -kHarmonics; n <= kHarmonics; ++n) {
      const double w = n * omega;
      matrix(n + kHarmonics, n + kHarmonics) += std::complex<double>(-w * w, damping * w);
    }
    Eigen::VectorXcd forces = Eigen::VectorXcd::Zero(matrix.rows());
    forces[kHarmonics] = load;
    const Eigen::VectorXcd part = matrix.partialPivLu().solve(forces);
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4096; ++i) {
      std::complex<double> value = 0.0;
      for (int n = -kHarmonics; n <= kHarmonics; ++n) {
        value += part[n + kHarmonics] * std::polar(1.0, 2.0 * kPi * n * i / 4096.0);
      }
      smallest = std::min(smallest, value.real());
    }
    return smallest;
  }

  // The largest exponent. Those of the middle harmonics are free of the series' end.
  double exponent() const {
    const Eigen::MatrixXcd k = stiffness();
    const Eigen::Index n = k.rows();
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
    matrix.topRightCorner(n, n).setIdentity();
    matrix.bottomLeftCorner(n, n) = -k;
    matrix.bottomRightCorner(n, n) = -damping * Eigen::MatrixXcd::Identity(n, n);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      matrix(i, i) -= std::complex<double>(0.0, omega * static_cast<double>(i % n - kHarmonics));
    }
    double largest = -std::numeric_limits<double>::infinity();
    // The same map of real and imaginary parts, which has the conjugates of its eigenvalues, too.
    Eigen::MatrixXd parts(4 * n, 4 * n);
    parts << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
    for (const std::complex<double>& one : eigenvalues_of(parts)) {
      if (std::abs(one.imag()) < 0.75 * omega) largest = std::max(largest, one.real());
    }
    return largest;
  }
};

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

// ---- gear_friction -----------------------------------------------------------------------------

// With equal gears the lever of friction is the same all along the line of action, and the mesh is
// piecewise constant: both pairs slide against each other while there are two, then one pair before
// the pitch point, then one behind it. Friction and stiffness alone make the teeth part in the
// second case, with a transmission error in the third.
TEST(ZooGearFriction, OrbitOfEqualGearsIsTheExactOne) {
  struct Case {
    double omega, mu, e;
    std::size_t crossings;
  };
  for (const Case& one : {Case{1.2, 0.1, 0.0, 0}, {0.74, 0.1, 0.0, 2}, {0.7, 0.3, 0.3, 2}}) {
    const double eps = 1.6, b = 1.0, F = 0.2, zeta = 0.03;
    const double lever = one.mu * std::tan(20.0 * kPi / 180.0);
    ExactPieces exact = {.omega = one.omega,
                         .limits = {{vector_of({1.0, 0.0}), b}, {vector_of({-1.0, 0.0}), b}},
                         .field = {},
                         .spells = {eps - 1.0, 0.5 * eps, 1.0}};
    exact.field = [&](const Sides& beyond, std::size_t spell) {
      const double mesh = (spell == 0 ? 2.0 : spell == 1 ? 1.0 - lever : 1.0 + lever) / eps;
      const double touch = beyond[0] || beyond[1] ? mesh : 0.0;
      LinearField field(2);
      field.slope << 0.0, 1.0, -touch, -2.0 * zeta * mesh;
      field.constant[1] = F + (beyond[0] ? touch * b : 0.0) - (beyond[1] ? touch * b : 0.0);
      field.cosine[1] = one.e * one.omega * one.omega;
      return field;
    };
    const Example example("gear_friction", {{"omega", one.omega}, {"mu", one.mu}, {"e", one.e}});
    // (h w)^4/120 is 5e-11 for each unit of phase, of which a period has some ten.
    expect_orbit(example, exact, one.crossings, 1e-9);
  }
}

// The divergence is -2 zeta times the mesh, whose mean over the way of a pair, from 0 to eps with
// the pitch point at p, is
// 1 - mu/eps (tan(alpha) (2 p - eps) - turn (p^2 + (eps - p)^2)/2),
// in contact and out of it. The equations jump at phases that steps end at, and steps are cut at
// the limits, so that nothing but the fourth order of 512 steps is left.
TEST(ZooGearFriction, ExponentsAddUpToTheMeanOfTheFriction) {
  const double eps = 1.7, p = 0.4 * eps, mu = 0.3, zeta = 0.03, share = 0.3, ratio = 2.0, z = 20.0;
  const double turn = (share - (1.0 - share) / ratio) * 2.0 * kPi / z;
  const double slip =
      std::tan(20.0 * kPi / 180.0) * (2.0 * p - eps) - 0.5 * turn * (p * p + (eps - p) * (eps - p));
  const double mean = 1.0 - mu / eps * slip;
  const double omega = 1.2;
  const Example example("gear_friction", {{"omega", omega},
                                          {"mu", mu},
                                          {"e", 0.3},
                                          {"eps", eps},
                                          {"approach", 0.4},
                                          {"share", share},
                                          {"ratio", ratio},
                                          {"z", z}});
  // One period from a start between the flanks, of which it meets one.
  const PeriodImage image = example.map(512).linearize(vector_of({0.9, 0.2}), 1).value();
  EXPECT_NEAR(std::log(image.monodromy.determinant()) / (2.0 * kPi / omega), -2.0 * zeta * mean,
              1e-10);
}

// ---- blankenship_kahraman ----------------------------------------------------------------------

const std::string kKahraman = "'period', 'contact_gap', 'contact_back', 'x_max'";

// In contact the deflection obeys Mathieu's equation under a load; teeth part where its smallest
// value reaches 0. Above the resonance that is the frequency at which a falling sweep jumps up.
TEST(ZooBlankenshipKahraman, TeethPartWhereMathieusMotionReachesZero) {
  const double kappa = 0.15, zeta = 0.03;
  double low = 1.0, high = 1.3;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    const Hill hill = {.damping = 2.0 * zeta, .kappa = kappa, .omega = middle};
    (hill.least(1.0) < 0.0 ? low : high) = middle;
  }
  // 4096 phases miss the smallest value by 1e-6 of the amplitude.
  for (const double part : {1.0 - 1e-5, 1.0 + 1e-5}) {
    const Points points = {.model = "blankenship_kahraman",
                           .parameters = "",
                           .axis = at_omega(low * part),
                           .start = {},
                           .quantities = kKahraman};
    const double gap = map_of(points.run(), "contact_gap")[0];
    EXPECT_EQ(gap > 0.0, part < 1.0) << low << ' ' << gap;
  }
}

// With parametric excitation alone, and while the back flank is not met, the force beyond the drive
// flank is homogeneous of degree one: with the load grows all of the motion from there, and nothing
// moves in frequency.
TEST(ZooBlankenshipKahraman, TheLoadScalesTheMotionAndMovesNoJump) {
  std::vector<double> highest, gaps;
  for (const double F : {0.05, 0.1, 0.2}) {
    const Points points = {.model = "blankenship_kahraman",
                           .parameters = "F = " + digits(F),
                           .axis = at_omega(0.95),
                           .start = {},
                           .quantities = kKahraman};
    const SweepResult result = points.run();
    EXPECT_EQ(map_of(result, "contact_back")[0], 0.0);
    highest.push_back((map_of(result, "x_max")[0] - 1.0) / F);
    gaps.push_back(map_of(result, "contact_gap")[0]);
  }
  EXPECT_GT(gaps[0], 0.1);
  for (std::size_t i : {1, 2}) {
    // The same numbers but for rounding, which grows with b/F.
    EXPECT_NEAR(highest[i], highest[0], 1e-10);
    EXPECT_NEAR(gaps[i], gaps[0], 1e-10);
  }
}

// Around twice the natural frequency the motion in contact is unstable from a kappa on that Hill's
// method gives; below, its exponent is Hill's.
TEST(ZooBlankenshipKahraman, ItsExponentsInContactAreHills) {
  for (const double kappa : {0.05, 0.1}) {
    const Hill hill = {.damping = 0.06, .kappa = kappa, .omega = 2.0};
    const Example example("blankenship_kahraman", {{"omega", 2.0}, {"kappa", kappa}});
    const std::complex<double> largest = example.orbit(200, 512).multipliers[0];
    // (h w)^4/120 of steps of 0.006.
    EXPECT_NEAR(std::log(std::abs(largest)) / kPi, hill.exponent(), 1e-10);
  }
  const Hill beyond = {.damping = 0.06, .kappa = 0.15, .omega = 2.0};
  ASSERT_GT(beyond.exponent(), 0.0);
  const Points points = {.model = "blankenship_kahraman",
                         .parameters = "kappa = 0.15",
                         .axis = at_omega(2.0),
                         .start = {},
                         .quantities = kKahraman};
  const SweepResult result = points.run();
  EXPECT_EQ(map_of(result, "period")[0], 2.0);
  EXPECT_GT(map_of(result, "contact_gap")[0], 0.0);
}

// ---- idler -------------------------------------------------------------------------------------

// Both meshes part, and meet their back flanks. With 30 teeth of the idler and the last gear
// straight behind it, the tooth between both flanks puts the second mesh half a period off.
TEST(ZooIdler, OrbitWithBothMeshesPartingIsTheExactOne) {
  const double omega = 0.9, F = 0.1, b1 = 1.0, b2 = 0.6, k = 1.3, m = 0.45, e1 = 0.5, e2 = 0.36,
               zeta = 0.05;
  // Over the mobility of driver and idler: driver, idler, last gear; dampers of both meshes.
  const double M1 = 1.0 / 0.55, M2 = 1.0 / m, M3 = M2 * 0.6 / 0.4, me2 = 0.6 * M2;
  const double c1 = 2.0 * zeta, c2 = 2.0 * zeta * std::sqrt(k * me2);
  ExactPieces exact = {.omega = omega,
                       .limits = {{vector_of({1.0, 0.0, 0.0, 0.0}), b1},
                                  {vector_of({-1.0, 0.0, 0.0, 0.0}), b1},
                                  {vector_of({0.0, 1.0, 0.0, 0.0}), b2},
                                  {vector_of({0.0, -1.0, 0.0, 0.0}), b2}},
                       .field = {}};
  exact.field = [&](const Sides& beyond, std::size_t) {
    const double first = beyond[0] || beyond[1] ? 1.0 : 0.0;
    const double second = beyond[2] || beyond[3] ? k : 0.0;
    const double first_rest = (beyond[0] ? -b1 : 0.0) + (beyond[1] ? b1 : 0.0);
    const double second_rest = k * ((beyond[2] ? -b2 : 0.0) + (beyond[3] ? b2 : 0.0));
    const double driver = 1.0 / M1 + 1.0 / M2, last = 1.0 / M3 + 1.0 / M2;
    LinearField field(4);
    field.slope << 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -driver * first, second / M2,
        -driver * c1, c2 / M2, first / M2, -last * second, c1 / M2, -last * c2;
    field.constant << 0.0, 0.0, F / M1 - driver * first_rest + second_rest / M2,
        F / M3 + first_rest / M2 - last * second_rest;
    // The errors are sines where a pair enters: a quarter of a period before the cosines are.
    field.cosine << 0.0, 0.0, e1 * omega * omega, -e2 * omega * omega;
    return field;
  };
  const Example example("idler",
                        {{"omega", omega},
                         {"e0_first", e1},
                         {"e0_second", e2 / b2},
                         {"e0_phase_first", 0.5 * kPi},
                         {"e0_phase_second", 0.5 * kPi}},
                        {{"stiffness_first", "constant"}, {"stiffness_second", "constant"}});
  expect_orbit(example, exact, 8, 1e-8);
}

// ---- two_flanks --------------------------------------------------------------------------------

TEST(ZooTwoFlanks, OrbitOnBothFlanksIsTheExactOne) {
  const double omega = 0.8, F = 0.1, e = 0.5, zeta = 0.05, drive_gap = 1.0, coast_gap = 0.4,
               coast = 4.0;
  ExactPieces exact = {
      .omega = omega,
      .limits = {{vector_of({1.0, 0.0}), drive_gap}, {vector_of({-1.0, 0.0}), coast_gap}},
      .field = {}};
  exact.field = [&](const Sides& beyond, std::size_t) {
    LinearField field(2);
    field.slope << 0.0, 1.0, beyond[0] ? -1.0 : beyond[1] ? -coast : 0.0, -2.0 * zeta;
    field.constant[1] = F + (beyond[0] ? drive_gap : 0.0) - (beyond[1] ? coast * coast_gap : 0.0);
    field.cosine[1] = e * omega * omega;
    return field;
  };
  // (h w)^4/120 at w = 2 and h = 0.008 is 5e-10.
  expect_orbit(Example("two_flanks", {{"omega", omega}, {"coast_stiffness", coast}}), exact, 4,
               1e-9);
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
  const double A = 1.2, a = 0.3, U = kPi;
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
    EXPECT_NEAR(std::log(std::abs(rest.multipliers[0])) * omega / (2.0 * kPi), hill.exponent(),
                1e-10);
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
    const double f = 0.3, V = 1.0 / (1.0 - w * w), half = kPi / w;
    const double q = -f * std::sin(half) / (w * (1.0 + std::cos(half)));
    double psi = std::asin(q / V);
    if (V < 0.0) psi = kPi - psi;  // the amplitude is positive
    // At phase pi or 0, whichever lies in the half period: minus the state at phase 0, or that.
    double phase = kPi;
    while (phase - psi > kPi) phase -= kPi;
    while (phase - psi < 0.0) phase += kPi;
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
