// The planetary set of the zoo against published rules and an eigenvalue problem of its own.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "orders/natural_modes.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kPi = std::numbers::pi;

std::string planetary_study(const std::string& options, const std::string& parameters) {
  return "[model]\nname = 'planetary'\n" + options + "[parameters]\n" + parameters +
         "[[axes]]\nname = 'omega'\nvalues = [0.7]\n";
}

// Spur gears with three planets that fit between sun and ring.
struct Teeth {
  int sun, planet, ring;

  static Teeth random(std::mt19937* numbers) {
    std::uniform_int_distribution<int> sun(15, 60), planet(15, 60);
    for (;;) {
      const Teeth teeth{sun(*numbers), planet(*numbers), 0};
      const Teeth whole{teeth.sun, teeth.planet, teeth.sun + 2 * teeth.planet};
      if (whole.has_room() && (whole.sun + whole.ring) % 3 == 0) return whole;
    }
  }
  bool has_room() const { return planet < (sun + planet) * std::sin(2.0 * kPi / 3.0); }
  std::string text() const {
    return fmt::format("zp_sun = {}\nteeth_ratio_sun = {:.17g}\nz_ring = {}\n", sun,
                       static_cast<double>(planet) / sun, ring);
  }
};

// The example of Lin and Parker 1999: masses in kg, inertias over radius squared in kg, springs in
// N/m, 24.6 degrees. SciPy's eigenvalues of M and K, written down by vectors of deflection in SI
// units, are in Hz. A rotation of all is free, those across come in pairs.
TEST(PlanetaryModes, OfLinAndParkersExampleAreSixRotationalAndSixPairs) {
  const double alpha = 24.6 * kPi / 180.0, distance = 0.09776, me = 0.39 * 0.61;
  const double sun = distance * std::cos(alpha) * 28.0 / 63.0, ring = sun * 98.0 / 28.0;
  const double varpi = std::sqrt(5e8 / me);
  const Study study = read_study(
      planetary_study(
          "ring = 'elastic'\nstiffness_sun = 'constant'\nstiffness_ring = 'constant'\n",
          fmt::format("zeta_sun = 0.0\nbeta = 0.0\ne0_sun = 0.0\n"
                      "rho_p_sun = 0.61\nm1_sun = {:.17g}\nm2_sun = {:.17g}\nvarpi_sun = {:.17g}\n"
                      "A_sun = {:.17g}\ninertia_carrier = {:.17g}\ninertia_ring = {:.17g}\n"
                      "turn_carrier = 1e-6\nturn_ring = {:.17g}\n",
                      me / 0.4, me / 0.66, varpi, distance / 5e-5, 6.29 * distance * distance,
                      3.0 * ring * ring, 1e9 * ring * ring)),
      "lin_parker");
  std::vector<double> hertz;
  for (const NaturalMode& mode : natural_modes(*study.model, study.setting)) {
    if (mode.frequency > 1e-3) hertz.push_back(mode.frequency * varpi / (2.0 * kPi));
  }
  const double expected[] = {743.2,  743.2,  1102.4, 1102.4, 1475.7, 1896.0, 1896.0, 1930.3, 2276.4,
                             2276.4, 2658.3, 6986.3, 6986.3, 7462.8, 9647.9, 9647.9, 11775.3};
  ASSERT_EQ(hertz.size(), std::size(expected));
  for (std::size_t i = 0; i < hertz.size(); ++i) EXPECT_NEAR(hertz[i], expected[i], 0.051) << i;
}

// With a fixed ring, rigid bearings of sun and carrier, and equal meshes that push straight across,
// turning modes are in closed form. Here the pins' stiffness is so high that planets turn with the
// carrier; a planet between both meshes, the sun at rest, has sqrt(2 k/J): twice, for the sum of
// what the sun feels is 0.
TEST(PlanetaryModes, PlanetsAgainstEachOtherHaveKahramansFrequency) {
  const Study study = read_study(
      planetary_study("stiffness_sun = 'constant'\nstiffness_ring = 'constant'\n",
                      "zeta_sun = 0.0\nbeta = 0.0\nk_pin = 1e12\n"
                      "k_sun = 1e12\nk_carrier = 1e12\nmass_carrier = 1e6\nm1_sun = 1e-5\n"),
      "kahraman");
  const double expected = std::sqrt(2.0 * 0.39);
  int found = 0;
  for (const NaturalMode& mode : natural_modes(*study.model, study.setting)) {
    if (std::fabs(mode.frequency / expected - 1.0) < 1e-3) ++found;
  }
  EXPECT_EQ(found, 2);
}

// Parker and Lin 2004: harmonic k of the meshes turns the sun and does not push it across where
// k z_sun is a multiple of the number of planets, and otherwise the other way round. What is left
// belongs to planets alone, and three planets have no such modes.
TEST(PlanetaryPhasing, TellsWhichHarmonicsTurnTheSunAndWhichPushIt) {
  std::mt19937 numbers(20040301);
  for (int trial = 0; trial < 6; ++trial) {
    const Teeth teeth = Teeth::random(&numbers);
    const Study study = read_study(
        planetary_study("error_sun = 'series'\nerror_ring = 'series'\nring = 'elastic'\n",
                        teeth.text() + "e0_sun = [0.02, 0.01, 0.01]\n"
                                       "e0_ring = [0.01, 0.02, 0.01]\n"
                                       "e0_phase_ring = [1.0, 2.0, 3.0]\n"),
        "teeth");
    const Model& model = *study.model;
    const std::size_t states = model.states.size();
    const std::vector<double> still = model.equilibrium(study.setting);
    const auto point = model.prepare(study.setting);
    const auto state = [&](const char* name) {
      return static_cast<std::size_t>(model.find_state(name));
    };
    for (const char* body : {"sun", "ring"}) {
      constexpr int kSamples = 3 * 256;  // a third of a period is whole samples
      std::vector<std::complex<double>> turns(4), pushes(4);
      std::vector<double> coefs(model.phase_coefs.size()), slope(states);
      for (int i = 0; i < kSamples; ++i) {
        const double psi = (i + 0.5) / kSamples;
        model.phase_coefs_at(study.setting, psi, psi, coefs.data());
        point->rhs(coefs.data(), still.data(), slope.data());
        for (int k = 1; k <= 3; ++k) {
          const std::complex<double> wave = std::polar(1.0 / kSamples, -2.0 * kPi * k * psi);
          const auto at = static_cast<std::size_t>(k);
          turns[at] += wave * slope[state(fmt::format("v_{}_u", body).c_str())];
          pushes[at] += wave * slope[state(fmt::format("v_{}_x", body).c_str())];
        }
      }
      for (int k = 1; k <= 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const bool is_turned = k * teeth.sun % 3 == 0;
        const double none = std::abs(is_turned ? pushes[at] : turns[at]);
        const double some = std::abs(is_turned ? turns[at] : pushes[at]);
        // Rounding, which breaks of the stiffness between samples do not touch.
        EXPECT_LT(none, 1e-12) << body << ' ' << teeth.text() << k;
        EXPECT_GT(some, 1e-4) << body << ' ' << teeth.text() << k;
      }
    }
  }
}

std::string planetary_refusal(const Teeth& teeth) {
  const Study study = read_study(planetary_study("", teeth.text()), "teeth");
  return study.model->check(study.setting);
}

TEST(PlanetaryTeeth, ThatCannotBeAssembledAreRefused) {
  using ::testing::HasSubstr;
  EXPECT_EQ(planetary_refusal({28, 35, 98}), "");
  EXPECT_THAT(planetary_refusal({28, 36, 100}),
              HasSubstr("the teeth of sun and ring are 128 together, and must be a multiple of 3"));
  EXPECT_THAT(planetary_refusal({12, 90, 192}), HasSubstr("in each other's way"));
  EXPECT_THAT(planetary_refusal({28, 35, 122}), HasSubstr("too large"));
  EXPECT_THAT(planetary_refusal({28, 35, 62}), HasSubstr("no room"));
}

}  // namespace
}  // namespace gearsweep::testing
