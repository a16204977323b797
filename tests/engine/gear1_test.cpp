// gear1: orbits against an outside opinion, its exact sum of exponents and limits (a Meissner
// oscillator, gear5 without shaft motion).
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using OscillatorState = std::array<double, 2>;

// An outside opinion: the equation written a second time, Boost.odeint's Fehlberg 7(8) steps, each
// edge of the backlash located by bisection and stepped on.
class OutsideOscillator {
 public:
  explicit OutsideOscillator(double omega) : omega_(omega) {}

  OscillatorState section_after(int periods) {
    const double h = 2.0 * std::numbers::pi / omega_ / kSteps;
    for (int step = 0; step < periods * kSteps; ++step) advance(step % kSteps * h, h);
    return state_;
  }

 private:
  static constexpr int kSteps = 512;

  static int flank_of(double x) { return x > 1.0 ? 1 : x < -1.0 ? -1 : 0; }

  OscillatorState stepped(double t, double h) {
    const auto slope = [this](const OscillatorState& s, OscillatorState& ds, double time) {
      double K = 1.0, F = 0.1;
      for (int r = 1; r <= 3; ++r) {
        const double k = r == 1 ? 0.2 : r == 2 ? 0.1 : 0.05;
        const double Fte = r == 1 ? 0.01 : r == 2 ? 0.004 : 0.002;
        K -= k * std::cos(r * omega_ * time);
        F += Fte * r * omega_ * r * omega_ * std::cos(r * omega_ * time);
      }
      ds[0] = s[1];
      ds[1] = F - 0.1 * s[1] - (flank_ == 0 ? 0.0 : K * (s[0] - flank_));
    };
    OscillatorState out;
    stepper_.do_step(slope, state_, t, out, h);
    return out;
  }

  void advance(double t, double left) {
    while (flank_of(stepped(t, left)[0]) != flank_) {
      double before = 0.0, after = left;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (before + after);
        (flank_of(stepped(t, middle)[0]) == flank_ ? before : after) = middle;
      }
      state_ = stepped(t, after);
      flank_ = flank_ == 0 ? flank_of(state_[0]) : 0;
      t += after;
      left -= after;
    }
    state_ = stepped(t, left);
  }

  double omega_;
  int flank_ = 1;
  OscillatorState state_ = {1.1, 0.0};
  boost::numeric::odeint::runge_kutta_fehlberg78<OscillatorState> stepper_;
};

// 300 periods damp what is left of the start to e^-90 at least; the outside steps, which do not end
// on the edges of the backlash, leave up to 1e-8.
TEST(Gear1, OrbitsAreThoseOfAnOutsideOpinion) {
  const SweepResult result = run(R"(
    [model]
    name = "gear1"
    preset = "spur"
    [[axes]]
    name = "omega"
    values = [0.5, 0.8, 1.0]
    [initial]
    state = {x = 1.1}
    [integrate]
    steps_per_period = 1024
    settle = 300
    record = 1
    stop = "never"
    [observe]
    quantities = ["x_max", "deflection_max", "backlash_mean", "poincare"]
    poincare = ["x", "v"]
  )");
  for (std::size_t i = 0; i < 3; ++i) {
    const double omega = result.study.axes[0].values[i];
    SCOPED_TRACE(omega);
    const OscillatorState outside = OutsideOscillator(omega).section_after(300);
    EXPECT_NEAR(samples_of(result, i, 0)[0], outside[0], 1e-8);
    EXPECT_NEAR(samples_of(result, i, 1)[0], outside[1], 1e-8);
    EXPECT_EQ(map_of(result, "deflection_max")[i], map_of(result, "x_max")[i]);
    EXPECT_EQ(map_of(result, "backlash_mean")[i], 1.0);
  }
}

// In chaos. The steps leave 2e-10 at this length, and the corrections of those in which contact is
// lost or met 7e-9.
TEST(Gear1, ExponentsAddUpToTheDivergence) {
  const SweepResult result = run(R"(
    [model]
    name = "gear1"
    preset = "coarse"
    [[axes]]
    name = "omega"
    values = [1.5, 1.8]
    [[axes]]
    name = "x"
    from = 1.05
    to = 1.15
    count = 8
    [integrate]
    steps_per_period = 128
    settle = 300
    record = 2000
    stop = "never"
    [observe]
    quantities = ["lyapunov_spectrum", "contact_class"]
  )");
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    EXPECT_NEAR(spectrum[2 * point] + spectrum[2 * point + 1], -0.1, 2e-8);
    EXPECT_GE(map_of(result, "contact_class")[point], 1.0);
  }
}

// The larger exponent of a linear oscillator with damping z whose stiffness is k1 during T1 and k2
// during T2 (Meissner 1918), from the trace and the determinant of its monodromy matrix, whose
// eigenvalues must be real.
double meissner_exponent(double k1, double k2, double T1, double T2, double z) {
  const double w1 = std::sqrt(k1 - z * z), w2 = std::sqrt(k2 - z * z), T = T1 + T2;
  const double trace =
      std::exp(-z * T) * (2.0 * std::cos(w1 * T1) * std::cos(w2 * T2) -
                          (w1 / w2 + w2 / w1) * std::sin(w1 * T1) * std::sin(w2 * T2));
  const double determinant = std::exp(-2.0 * z * T);
  const double half = 0.5 * std::abs(trace);
  return std::log(half + std::sqrt(half * half - determinant)) / T;
}

// Without backlash a square wave makes a Meissner oscillator. Where its multipliers are real the
// tangents line up with them, and each period's growth is the multiplier; the rest is the error of
// the steps, which end on the jumps: h^4 w^5/120 is 8e-9 at the largest step (0.023, at omega
// 0.53) during the stiff part (w^2 = 1.6), less on average.
TEST(Gear1, SquareWaveIsAMeissnerOscillator) {
  const double share = 0.3, k = 0.6, z = 0.1;
  const std::vector<double> omegas = {0.53, 0.72, 1.08, 2.0, 2.2};
  const SweepResult result = run(R"(
    [model]
    name = "gear1"
    stiffness = "square"
    [parameters]
    b = 0.0
    Fm = 0.0
    Fte = [0.0, 0.0, 0.0]
    k = [0.6, 0.0, 0.0]
    share = 0.3
    z = 0.1
    [[axes]]
    name = "omega"
    values = [0.53, 0.72, 1.08, 2.0, 2.2]
    [initial]
    policy = "fixed"
    state = {x = 1e-3}
    [integrate]
    steps_per_period = 512
    settle = 100
    record = 10
    [observe]
    quantities = ["lyapunov_spectrum"]
  )");
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  for (std::size_t i = 0; i < omegas.size(); ++i) {
    const double T = 2.0 * std::numbers::pi / omegas[i];
    const double larger = meissner_exponent(1.0 - k, 1.0 + k, share * T, (1.0 - share) * T, z);
    EXPECT_NEAR(spectrum[2 * i], larger, 5e-9) << omegas[i];
    EXPECT_NEAR(spectrum[2 * i + 1], -2.0 * z - larger, 5e-9) << omegas[i];
  }
}

// m1 = m2 = 0 and no friction: the shafts stand still, and gear5's deflection is gear1's x with
// z = 2 zeta. gear5 forces with a sine and gear1 with a cosine, so the stiffness is turned by a
// quarter period, and what does not depend on the origin of time is compared.
TEST(Gear1, IsGear5WithoutShaftMotion) {
  const std::string common = R"(
    [[axes]]
    name = "omega"
    values = [0.5, 0.8, 1.0]
    [integrate]
    steps_per_period = 4096
    settle = 300
    record = 1
    stop = "never"
    [observe]
    quantities = ["deflection_min", "deflection_max", "deflection_mean", "deflection_rms", "dmf_max"]
  )";
  const SweepResult shafts = run(R"(
    [model]
    name = "gear5"
    stiffness = "fourier"
    [parameters]
    m1 = 0.0
    m2 = 0.0
    mu = 0.0
    zeta = 0.025
    F1 = 0.1
    e0 = 0.05
    kappa = [0.2]
    phase = [1.5707963267948966]
  )" + common);
  const SweepResult rigid = run(R"(
    [model]
    name = "gear1"
    [parameters]
    z = 0.05
    Fm = 0.1
    Fte = [0.05, 0.0, 0.0]
    k = [0.2, 0.0, 0.0]
  )" + common);
  for (const char* quantity :
       {"deflection_min", "deflection_max", "deflection_mean", "deflection_rms", "dmf_max"}) {
    for (std::size_t i = 0; i < 3; ++i) {
      // The steps' ends lie elsewhere: (h/2)^2/2 |x''| at an extreme is 5e-7 at the largest h.
      EXPECT_NEAR(map_of(shafts, quantity)[i], map_of(rigid, quantity)[i], 5e-7) << quantity;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
