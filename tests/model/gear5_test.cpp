// gear5's parameters, presets and phase coefficients.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "support/mesh.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

// The model's description, its table of parameters; what a preset does not name is `consistent`.
const std::map<std::string, double> kConsistent = {
    {"omega", 0.7},    {"b", 1.0},           {"mu", 0.05},      {"F1", 0.1},   {"e0", 0.2},
    {"zeta", 0.04008}, {"m1", 0.3507525},    {"m2", 0.3507525}, {"k1", 1.38},  {"k2", 1.38},
    {"k3", 1.38},      {"k4", 1.38},         {"c1", 2.0},       {"c2", 2.0},   {"c3", 2.0},
    {"c4", 2.0},       {"eps", 1.718},       {"alpha", 20.0},   {"A", 2400.0}, {"rho_p", 0.5},
    {"rho_g", 0.5},    {"teeth_ratio", 1.0}, {"q", 0.35}};

TEST(Gear5, DefaultsAreThePresetConsistent) {
  for (const auto& [name, value] : kConsistent) {
    EXPECT_EQ(parameter_of(gear5().default_setting(), name), value) << name;
  }
  EXPECT_EQ(option_of(gear5().default_setting(), "formulation"), "consistent");
  EXPECT_EQ(option_of(gear5().default_setting(), "backlash"), "constant");
  EXPECT_EQ(option_of(gear5().default_setting(), "stiffness"), "parabolic");
  ASSERT_EQ(gear5().presets.size(), 3U);
  EXPECT_EQ(gear5().presets[0].name, "consistent");
  EXPECT_EQ(gear5().presets[0].toml, "");
}

TEST(Gear5, DefaultsAreWithinTheirRanges) {
  std::set<std::string> names;
  for (const ParameterInfo& parameter : gear5().parameters) {
    EXPECT_GE(parameter.default_value, parameter.min) << parameter.name;
    EXPECT_LE(parameter.default_value, parameter.max) << parameter.name;
    EXPECT_FALSE(parameter.unit.empty()) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
  }
  EXPECT_EQ(gear5().check(gear5().default_setting()), "");
}

TEST(Gear5, MobilitySharesMustSumToOne) {
  ModelSetting setting = gear5().default_setting();
  set_parameter(&setting, "rho_p", 0.6);
  EXPECT_NE(gear5().check(setting), "");
}

const std::vector<std::string> kShapes = {"parabolic", "rectangular", "fourier"};

Mesh at(const ModelSetting& setting, double psi) { return mesh_at(gear5(), setting, psi, psi); }

// Mean over the period, segment by segment, by Simpson's rule, which is exact for a parabola and,
// with 200 parts, good to 1e-11 for the fourth harmonic.
double mean_stiffness(const ModelSetting& setting) {
  const double leaves = parameter_of(setting, "eps") - 1.0;
  const double grown = parameter_of(setting, "engagement");
  std::vector<double> bounds = {0.0, leaves, grown, std::fmod(leaves + 1.0 - grown, 1.0), 1.0};
  std::sort(bounds.begin(), bounds.end());
  const MeshReader mesh(gear5(), setting);
  const auto stiffness = [&](double psi) { return mesh.at(psi, psi).stiffness; };
  double sum = 0.0;
  for (std::size_t segment = 0; segment + 1 < bounds.size(); ++segment) {
    const double from = bounds[segment], to = bounds[segment + 1];
    constexpr int kParts = 200;
    const double h = (to - from) / kParts;
    for (int i = 0; i < kParts; ++i) {
      const double left = from + h * i;
      const double tiny = 1e-13;  // stay inside at the ends
      sum +=
          h / 6.0 *
          (stiffness(left + tiny) + 4.0 * stiffness(left + 0.5 * h) + stiffness(left + h - tiny));
    }
  }
  return sum;
}

TEST(Gear5, StiffnessHasMeanOne) {
  for (const std::string& shape : kShapes) {
    for (const double eps : {1.1, 1.5, 1.718, 1.95}) {
      ModelSetting setting = gear5().default_setting();
      set_option(&setting, "stiffness", shape);
      set_parameter(&setting, "eps", eps);
      set_parameter(&setting, "q", 0.6);
      set_parameter(&setting, "kappa_3", 0.1);
      set_parameter(&setting, "phase_3", 1.0);
      EXPECT_NEAR(mean_stiffness(setting), 1.0, 1e-9) << shape << ", " << eps;
      if (shape == "fourier") continue;
      for (const double engagement : {0.05, 0.3, 0.5}) {
        set_parameter(&setting, "engagement", engagement);
        EXPECT_NEAR(mean_stiffness(setting), 1.0, 1e-9)
            << shape << ", " << eps << ", " << engagement;
      }
    }
  }
}

// Half-way into the engagement a pair has half of its stiffness; where it enters and leaves, none.
TEST(Gear5, EngagementIsGradual) {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "stiffness", "rectangular");
  set_parameter(&setting, "eps", 1.5);
  set_parameter(&setting, "engagement", 0.2);
  const double pair = 1.0 / (1.5 - 0.2);
  EXPECT_NEAR(at(setting, 1e-12).stiffness, pair, 1e-9);
  EXPECT_NEAR(at(setting, 0.1).stiffness, 1.5 * pair, 1e-12);
  EXPECT_NEAR(at(setting, 0.25).stiffness, 2.0 * pair, 1e-12);
  EXPECT_NEAR(at(setting, 0.4).stiffness, 1.5 * pair, 1e-12);
  EXPECT_NEAR(at(setting, 0.5 - 1e-12).stiffness, pair, 1e-9);
  EXPECT_NEAR(at(setting, 0.7).stiffness, pair, 1e-12);
}

TEST(Gear5, FourierStiffnessIsTheSumOfItsHarmonics) {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "stiffness", "fourier");
  const char* suffixes[4] = {"", "_2", "_3", "_4"};
  const double amplitudes[4] = {0.3, 0.2, 0.1, 0.05};
  const double phases[4] = {0.4, 1.0, -2.0, 3.0};
  for (int i = 0; i < 4; ++i) {
    set_parameter(&setting, std::string("kappa") + suffixes[i], amplitudes[i]);
    set_parameter(&setting, std::string("phase") + suffixes[i], phases[i]);
  }
  for (const double psi : {0.01, 0.3, 0.8, 0.95}) {
    double expected = 1.0;
    for (int i = 0; i < 4; ++i) {
      expected += amplitudes[i] * std::cos(2.0 * std::numbers::pi * (i + 1) * psi + phases[i]);
    }
    EXPECT_NEAR(at(setting, psi).stiffness, expected, 1e-14);
  }
}

// The arms of equal gears add up to 2 tan(alpha), and each torsional share is one half: friction
// turns both gears by tan(alpha), wherever the pair is.
TEST(Gear5, FrictionArmsOfEqualGearsAreTanAlpha) {
  ModelSetting setting = gear5().default_setting();
  const double tan_alpha = std::tan(20.0 * std::numbers::pi / 180.0);
  for (const double psi : {0.1, 0.5, 0.75, 0.84, 0.9, 0.99}) {
    const double directions = at(setting, psi).slide_damping;
    EXPECT_NEAR(at(setting, psi).lever_damping, directions * tan_alpha, 1e-14);
    EXPECT_NEAR(at(setting, psi).lever, at(setting, psi).slide * tan_alpha, 1e-14);
  }
}

// In single contact the arms of unequal gears are those of the geometry: s_p grows by 2 pi/zp
// radii per base pitch and is Rp tan(alpha) at the pitch point; s_p + s_g = (Rp + Rg) tan(alpha).
TEST(Gear5, FrictionArmsOfUnequalGears) {
  ModelSetting setting = gear5().default_setting();
  for (const auto& [name, value] : std::map<std::string, double>{{"teeth_ratio", 2.5},
                                                                 {"zp", 20.0},
                                                                 {"rho_p", 0.7},
                                                                 {"rho_g", 0.3},
                                                                 {"approach", 0.45}}) {
    set_parameter(&setting, name, value);
  }
  const double tan_alpha = std::tan(20.0 * std::numbers::pi / 180.0);
  const double pitch_point = 0.45 * 1.718;
  for (const double psi : {0.72, 0.76, 0.8, 0.98}) {
    const double s_p = tan_alpha + (psi - pitch_point) * 2.0 * std::numbers::pi / 20.0;
    const double s_g = (3.5 * tan_alpha - s_p) / 2.5;
    const double direction = psi < pitch_point ? 1.0 : -1.0;
    EXPECT_DOUBLE_EQ(at(setting, psi).slide_damping, direction);
    EXPECT_NEAR(at(setting, psi).lever_damping, direction * (0.7 * s_p + 0.3 * s_g), 1e-14);
  }
}

// Eqs. (9) and (14) as printed: the gear's arm for both gears, the sliding direction reversed.
TEST(Gear5, FrictionArmsAsPrinted) {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "formulation", "printed");
  const double tan_alpha = std::tan(20.0 * std::numbers::pi / 180.0);
  for (const double psi : {0.75, 0.84, 0.9}) {
    const double s_g = tan_alpha - (psi - 0.859) * 2.0 * std::numbers::pi / 40.0;
    const double direction = psi < 0.859 ? 1.0 : -1.0;
    EXPECT_NEAR(at(setting, psi).lever_damping, direction * s_g, 1e-14);
    EXPECT_DOUBLE_EQ(at(setting, psi).slide_damping, -direction);
  }
}

// Eq. (20) with the subtraction that the model avoids: distances of 2400 half backlashes lose the
// last 2400 * 1e-16 = 3e-13, moved shafts of the size of 1.
TEST(Gear5, DynamicBacklashIsThatOfTheGeometry) {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "backlash", "dynamic");
  const double alpha = 20.0 * std::numbers::pi / 180.0;
  const double A = 2400.0;
  std::vector<double> coefs(gear5().phase_coefs.size());
  gear5().phase_coefs_at(setting, 0.5, 0.5, coefs.data());
  const std::unique_ptr<PreparedPoint> point = gear5().prepare(setting);
  for (const double size : {0.0, 0.01, 1.0, 30.0}) {
    const double x[10] = {0.2, 0.3 * size, -0.5 * size, size, 0.7 * size, 0, 0, 0, 0, 0};
    const double S = std::sqrt(std::pow(A * std::cos(alpha) + x[3] - x[1], 2) +
                               std::pow(x[4] - A * std::sin(alpha) - x[2], 2));
    std::vector<double> signals(gear5().signals.size());
    point->signals(coefs.data(), x, signals.data());
    EXPECT_NEAR(signals[signal_index(gear5(), "backlash")], 1.0 + (S - A) * std::tan(alpha), 1e-12);
    EXPECT_EQ(signals[signal_index(gear5(), "deflection")], x[0] - x[2] + x[4]);
  }
}

}  // namespace
}  // namespace gearsweep::testing
