// K_v against example 1 of ISO/TR 6336-30 and the limits of the standard's formulas.
#include "gear/dynamic_factor.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// ISO/TR 6336-30, example 1, as gfsReboucas/Drivetrain quotes it (MATISO_6336.m): module 8 mm,
// 17/103 teeth, helix 15.8 degrees, face width 100 mm, rack D of ISO 53 (dedendum 1.4 modules),
// 9000 N m, 360 rpm, grade 5, a tip relief of 70 um.
struct Example {
  double module = 8.0, helix = 15.8 * std::numbers::pi / 180.0, width = 100.0;
  double teeth[2] = {17.0, 103.0}, shift[2] = {0.145, 0.0};
  double torque = 9000.0, speed = 360.0, relief = 70.0;
  double single = 12.3705, mesh = 17.4648;  // published c' and c_gamma, N/(mm um)
  double factor = 1.003;                    // published K_v

  double diameter(int i) const { return module * teeth[i] / std::cos(helix); }
  double angle() const {
    return std::atan(std::tan(20.0 * std::numbers::pi / 180.0) / std::cos(helix));
  }
  // That of a steel disc whose diameter is the mean of tip and root, as the standard has it; kg
  // mm^2.
  double inertia(int i) const {
    const double tip = diameter(i) + 2.0 * module * (1.0 + shift[i]);
    const double root = diameter(i) - 2.0 * module * (1.4 - shift[i]);
    return std::numbers::pi / 32.0 * 7.83e-6 * width * std::pow(0.5 * (tip + root), 4);
  }
  // By grade 5 of ISO 1328-1:1995, for the wheel, which has the larger ones; um.
  double pitch_deviation() const {
    return (0.3 * (module + 0.4 * std::sqrt(diameter(1))) + 4.0) * std::cos(angle());
  }
  double profile_deviation() const {
    return 2.5 * std::sqrt(module) + 0.17 * std::sqrt(diameter(1)) + 0.5;
  }
  double line_load() const { return 2e3 * torque / diameter(0) / width; }
  // N = n1/n_E1 with n_E1 = 30000/(pi z1) sqrt(c_gamma/m_red).
  double resonance_ratio() const {
    double mobility = 0.0;
    for (int i = 0; i < 2; ++i) {
      mobility += std::pow(0.5 * diameter(i) * std::cos(angle()), 2) / (inertia(i) / width);
    }
    return speed * std::numbers::pi * teeth[0] / 3e4 / std::sqrt(mesh * mobility);
  }
  std::string study() const {
    return fmt::format(
        "[gear]\nteeth = [17, 103]\nmodule_mm = 8\nprofile_shift = [0.145, 0]\n"
        "centre_distance_mm = 500\nhelix_angle_deg = 15.8\nface_width_mm = 100\n"
        "dedendum_mm = 11.2\ninertia_kg_mm2 = [{}, {}]\nmass_kg = [10, 400]\n"
        "bearing_stiffness_N_per_mm = 1e6\nbearing_damping_N_s_per_mm = 1\n"
        "mesh_damping_N_s_per_mm = 1\nhalf_backlash_mm = 0.1\ntorque_N_m = 9000\n"
        "transmission_error_um = 5\npinion_speed_rpm = 360\npitch_deviation_um = {}\n"
        "profile_form_deviation_um = {}\ntip_relief_um = 70\n"
        "[[axes]]\nname = 'torque_N_m'\nvalues = [4500, 9000]\n",
        inertia(0), inertia(1), pitch_deviation(), profile_deviation());
  }
};

DynamicFactorInput pair_of(const Example& example) {
  return {example.single,
          2.6327,  // 1.5493 transverse and 1.0834 overlap
          example.pitch_deviation(),
          example.profile_deviation(),
          example.relief,
          0.0};
}

double parameter_of(const Study& study, const std::string& name) {
  return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
}

TEST(DynamicFactor, IsThatOfTheStandardsExample) {
  const Example example;
  const double factor =
      dynamic_factor(pair_of(example), example.line_load(), example.resonance_ratio());
  EXPECT_NEAR(factor, example.factor, 5e-4);  // as it is rounded
  EXPECT_NEAR(factor - 1.0, 0.0033, 1e-4);
}

// From the drawing: the stiffness, too, is our own.
TEST(DynamicFactor, OfAStudyIsThatOfTheStandardsExample) {
  const Example example;
  const Study study = read_study(example.study(), "s.toml");
  ASSERT_TRUE(study.dynamic_factor);
  const DynamicFactorInput& pair = *study.dynamic_factor;
  EXPECT_NEAR(pair.single_stiffness, example.single, 0.005 * example.single);
  EXPECT_NEAR(study.scales.k0 * 1e-6 / example.width, example.mesh, 0.005 * example.mesh);
  EXPECT_NEAR(pair.contact_ratio, 2.6327, 1e-4);
  // The mesh frequency in varpi is the standard's ratio of speeds, but for the stiffness.
  const double omega = parameter_of(study, "omega");
  EXPECT_NEAR(omega, example.resonance_ratio(), 0.0025 * omega);
  // The first torque of the axis is half of the example's.
  const double line_load = 2.0 * pair.line_load_per_load * parameter_of(study, "F1");
  EXPECT_NEAR(line_load, example.line_load(), 1e-9 * line_load);
  EXPECT_NEAR(dynamic_factor(pair, line_load, omega), example.factor, 5e-4);
}

TEST(DynamicFactor, GoesToOneWithTheSpeed) {
  const DynamicFactorInput pair = pair_of({});
  for (const double load : {20.0, 1000.0}) {
    EXPECT_EQ(dynamic_factor(pair, load, 0.0), 1.0);
    EXPECT_NEAR(dynamic_factor(pair, load, 1e-9), 1.0, 1e-8);
  }
}

TEST(DynamicFactor, HasNoJumpAroundTheIntermediateRange) {
  for (const double eps : {1.3, 1.7, 2.3, 2.8}) {
    DynamicFactorInput pair = pair_of({});
    pair.contact_ratio = eps;
    for (const double ratio : {1.15, 1.5}) {
      EXPECT_NEAR(dynamic_factor(pair, 300.0, ratio), dynamic_factor(pair, 300.0, ratio + 1e-9),
                  1e-8);
    }
    const double middle = dynamic_factor(pair, 300.0, 1.325);
    EXPECT_NEAR(2.0 * middle, dynamic_factor(pair, 300.0, 1.15) + dynamic_factor(pair, 300.0, 1.5),
                1e-12);
  }
}

// Without deviations and tip relief the constants stand alone: K_v = 1 + N C_v3, 1 + C_v4, C_v7.
TEST(DynamicFactor, OfAPerfectPairIsWhatTheConstantsSay) {
  DynamicFactorInput pair{14.0, 1.6, 0.0, 0.0, {}, 0.0};
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 0.5), 1.115, 1e-12);
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 1.0), 1.9, 1e-12);
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 2.0), 0.875 - 0.125 * std::sin(0.4 * std::numbers::pi),
              1e-12);
  pair.contact_ratio = 1.4;
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 2.0), 0.75, 1e-12);
  pair.contact_ratio = 2.56;
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 0.5), 1.048, 1e-12);
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 1.0), 1.0 + 0.442 / 1.12, 1e-12);
  EXPECT_NEAR(dynamic_factor(pair, 200.0, 2.0), 1.0, 1e-12);
}

// N_S = 0.5 + 0.35 sqrt(F/100): 0.675 at 25 N/mm.
TEST(DynamicFactor, UnderALightLoadTheMainResonanceBeginsEarlier) {
  const DynamicFactorInput pair{14.0, 1.6, 0.0, 0.0, {}, 0.0};
  EXPECT_LT(dynamic_factor(pair, 25.0, 0.67), 1.2);
  EXPECT_NEAR(dynamic_factor(pair, 25.0, 0.68), 1.9, 1e-12);
  EXPECT_LT(dynamic_factor(pair, 100.0, 0.849), 1.2);
  EXPECT_NEAR(dynamic_factor(pair, 100.0, 0.851), 1.9, 1e-12);
  EXPECT_TRUE(std::isnan(dynamic_factor(pair, 0.0, 1.0)));
}

TEST(DynamicFactor, RunningInTakesASmallShareAndThreeMicrometresAtMost) {
  EXPECT_NEAR(run_in_deviation(20.0), 18.5, 1e-12);
  EXPECT_NEAR(run_in_deviation(100.0), 97.0, 1e-12);
}

TEST(DynamicFactor, NeedsAllThatItTakes) {
  const std::string whole = Example().study();
  const auto without = [&](const std::string& key) {
    const std::size_t at = whole.find(key);
    return whole.substr(0, at) + whole.substr(whole.find('\n', at) + 1);
  };
  EXPECT_THAT(refusal(without("pitch_deviation_um")),
              AllOf(HasSubstr("s.toml:"), HasSubstr("needs 'pitch_deviation_um'")));
  EXPECT_THAT(refusal(without("profile_form_deviation_um")),
              HasSubstr("needs 'profile_form_deviation_um'"));
  EXPECT_TRUE(read_study(without("tip_relief_um"), "s.toml").dynamic_factor);
  EXPECT_THAT(refusal(whole, {"gear.dedendum_mm=40"}), HasSubstr("1 to 2 modules"));
  EXPECT_THAT(refusal(whole, {"gear.mesh_stiffness_N_per_m=1e9"}), HasSubstr("dedendum_mm"));
}

// The face width beside a given stiffness is for K_v alone.
TEST(DynamicFactor, TakesAGivenMeshStiffness) {
  const std::string given =
      "[gear]\nteeth = [20, 40]\nmodule_mm = 4\ncontact_ratio = 1.6\ninertia_kg_mm2 = 600\n"
      "mass_kg = 1\nbearing_stiffness_N_per_mm = 1e5\nbearing_damping_N_s_per_mm = 1\n"
      "mesh_damping_N_s_per_mm = 0.5\nhalf_backlash_mm = 0.04\nmesh_stiffness_N_per_m = 4e8\n"
      "torque_N_m = 150\ntransmission_error_um = 6\nface_width_mm = 20\n"
      "pitch_deviation_um = 8\nprofile_form_deviation_um = 9\n";
  const std::string axis = "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n";
  const Study study = read_study(given + axis, "s.toml");
  ASSERT_TRUE(study.dynamic_factor);
  EXPECT_NEAR(study.dynamic_factor->single_stiffness, 20.0 / 1.45, 1e-12);  // c_gamma = 20
  // 150 N m at a radius of 40 mm over 20 mm.
  EXPECT_NEAR(study.dynamic_factor->line_load_per_load * parameter_of(study, "F1"), 187.5, 1e-9);
  for (const char* key : {"pitch_deviation_um", "face_width_mm"}) {
    EXPECT_THAT(refusal(given + "[[axes]]\nname = '" + key + "'\nvalues = [8, 9]\n"),
                AllOf(HasSubstr(key), HasSubstr("changes nothing in the equations")));
  }
}

}  // namespace
}  // namespace gearsweep::testing
