// gear1: reference orbits, chaotic exponents, its exact limits (a Meissner oscillator, gear5 without
// shaft motion).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

struct Orbit {
  double omega, x, v, least, greatest;
};

// From the description of the models, section "Published answers"; the start is the preset's.
TEST(Gear1, ReferenceOrbits) {
  const std::vector<Orbit> orbits = {
      {0.5, 1.03825294, 0.08857418, 0.951039, 1.242391},
      {0.8, 1.16062296, 0.01407026, 1.013464, 1.176121},
      {1.0, 0.99098839, 0.09992943, 0.951462, 1.227989},
  };
  // 300 periods damp what is left of the start to e^-90 at least. The steps' ends miss an extreme by
  // (h/2)^2/2 |x''|, 1e-6 of which is 1e-7 here, and an edge of the backlash that a step crosses
  // leaves an error of second order in its length in the section.
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
    steps_per_period = 16384
    settle = 300
    record = 1
    [observe]
    quantities = ["x_min", "x_max", "deflection_max", "backlash_mean", "poincare"]
    poincare = ["x", "v"]
  )");
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    SCOPED_TRACE(orbits[i].omega);
    printf("%.10f %.10f %.8f %.8f\n", samples_of(result, i, 0)[0], samples_of(result, i, 1)[0],
           map_of(result, "x_min")[i], map_of(result, "x_max")[i]);
    EXPECT_NEAR(samples_of(result, i, 0)[0], orbits[i].x, 5e-9);
    EXPECT_NEAR(samples_of(result, i, 1)[0], orbits[i].v, 5e-9);
    EXPECT_NEAR(map_of(result, "x_min")[i], orbits[i].least, 5e-7);
    EXPECT_NEAR(map_of(result, "x_max")[i], orbits[i].greatest, 5e-7);
    EXPECT_EQ(map_of(result, "deflection_max")[i], map_of(result, "x_max")[i]);
    EXPECT_EQ(map_of(result, "backlash_mean")[i], 1.0);
  }
}

// Published with +-0.004; 64 starts of 2000 periods have a standard error of a tenth of that.
TEST(Gear1, ChaoticExponents) {
  const std::size_t starts = 64;
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
    count = 64
    [integrate]
    steps_per_period = 128
    settle = 300
    record = 2000
    [observe]
    quantities = ["lyapunov_spectrum", "lyapunov_max", "contact_class"]
  )");
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  const std::vector<double>& largest = map_of(result, "lyapunov_max");
  double mean[2] = {0.0, 0.0};
  for (std::size_t point = 0; point < 2 * starts; ++point) {
    mean[point % 2] += largest[point] / starts;
    EXPECT_NEAR(spectrum[2 * point] + spectrum[2 * point + 1], -0.1, 1e-6);
    EXPECT_NEAR(spectrum[2 * point], largest[point], 1e-6);
    EXPECT_GE(map_of(result, "contact_class")[point], 1.0);
  }
  printf("%g %g sum err %g\n", mean[0], mean[1], spectrum[0] + spectrum[1] + 0.1);
  EXPECT_NEAR(mean[0], 0.095, 0.004);
  EXPECT_NEAR(mean[1], 0.120, 0.004);
}

// Larger and smaller exponent of a linear oscillator whose stiffness is w1^2 during T1 and w2^2
// during T2 (undamped values), from the monodromy matrix (Meissner 1918).
std::pair<double, double> meissner_exponents(double k1, double k2, double T1, double T2, double z) {
  const double w1 = std::sqrt(k1 - z * z), w2 = std::sqrt(k2 - z * z), T = T1 + T2;
  const double half = 0.5 * std::exp(-z * T) *
                      (2.0 * std::cos(w1 * T1) * std::cos(w2 * T2) -
                       (w1 / w2 + w2 / w1) * std::sin(w1 * T1) * std::sin(w2 * T2));
  const double discriminant = half * half - std::exp(-2.0 * z * T);
  if (discriminant <= 0.0) return {-z, -z};
  const double great = std::abs(half) + std::sqrt(discriminant);
  return {std::log(great) / T, -2.0 * z - std::log(great) / T};
}

// Without backlash and mean load nothing but the tangent vectors moves, and a square wave makes a
// Meissner oscillator. Where its multipliers are real the tangents line up with them, and each
// period's growth is the multiplier; 2e-9 is the error of the steps, which end on the jumps.
TEST(Gear1, SquareWaveIsAMeissnerOscillator) {
  const double share = 0.3, k = 0.6, z = 0.1;
  const std::vector<double> omegas = {0.6, 0.65, 0.9, 0.95, 1.9, 2.0};
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
    values = [0.6, 0.65, 0.9, 0.95, 1.9, 2.0]
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
    const auto [larger, smaller] =
        meissner_exponents(1.0 - k, 1.0 + k, share * T, (1.0 - share) * T, z);
    printf("w %g: %.10f %.10f exact %.10f %.10f\n", omegas[i], spectrum[2 * i],
           spectrum[2 * i + 1], larger, smaller);
    EXPECT_NEAR(spectrum[2 * i], larger, 2e-9) << omegas[i];
    EXPECT_NEAR(spectrum[2 * i + 1], smaller, 2e-9) << omegas[i];
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
      printf("%s %.10f %.10f\n", quantity, map_of(shafts, quantity)[i], map_of(rigid, quantity)[i]);
      // The steps' ends lie elsewhere: (h/2)^2/2 |x''| at an extreme, less elsewhere.
      EXPECT_NEAR(map_of(shafts, quantity)[i], map_of(rigid, quantity)[i], 1e-6) << quantity;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
