// Gears whose damage over the path of contact, or whose torque over a turn, is measured.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measured_gear.hpp"
#include "model/error.hpp"
#include "plan/phase_grid.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// So the motion has its bits, too.
TEST(MeasuredGear, ALevelCurveOfDamageIsTheDamage) {
  for (const bool is_pinion : {true, false}) {
    const std::string key = is_pinion ? "pinion_damage_file" : "gear_damage_file";
    const std::string damage = is_pinion ? "damage = [0.4, 0]\n" : "damage = [0, 0.4]\n";
    const std::string level = "0.2, 0.4\n0.7, 0.4\n";
    for (const bool is_measured : {true, false}) {
      const std::string stiffness = is_measured ? "stiffness_file = 'k.csv'\n" : "";
      const std::string table = is_measured ? held_table("k.csv", "0 1e8\n2 3e8\n4 2e8\n") : "";
      const std::string tables = is_measured ? fmt::format("{}'d.csv' = '''\n{}'''\n", table, level)
                                             : held_table("d.csv", level);
      const std::string keys = kOneSine + stiffness;
      const Study factor = measured_study(keys + damage, table);
      const Study curve = measured_study(fmt::format("{}{} = 'd.csv'\n", keys, key), tables);
      const std::vector<double> bounds = segment_bounds(*factor.model, factor.setting);
      EXPECT_EQ(segment_bounds(*curve.model, curve.setting), bounds);
      for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        const double inside = 0.5 * (bounds[i] + bounds[i + 1]);
        for (const double psi : {bounds[i], inside, bounds[i + 1]}) {
          for (const char* name : {"stiffness", "lever", "slide"}) {
            EXPECT_NEAR(mesh_of(curve, psi, inside).part(name),
                        mesh_of(factor, psi, inside).part(name), 1e-15)
                << name;
          }
        }
      }
    }
  }
}

// By hand: tooth 0 of 20 enters at 0 and leaves at 1.3; its pair is alone from 0.3 to 1.
TEST(MeasuredGear, DamageGoesOverThePathOfContact) {
  const Study sound = measured_study(kOneSine);
  const Study study = measured_study(kOneSine + "pinion_damage_file = 'd.csv'\n",
                                     held_table("d.csv", "share, lost\n0, 0\n0.5, 0.2\n1, 0.6\n"));
  EXPECT_EQ(parameter_of(study.setting, "cycle"), 20.0);
  const auto left = [&](double mesh_periods) {
    return mesh_of(study, mesh_periods / 20.0).stiffness / mesh_of(sound, mesh_periods).stiffness;
  };
  EXPECT_NEAR(left(0.325), 0.9, 1e-12);
  EXPECT_NEAR(left(0.65), 0.8, 1e-12);
  EXPECT_NEAR(left(0.975), 0.6, 1e-12);
  EXPECT_NEAR(mesh_of(study, 1.5 / 20.0).stiffness, mesh_of(sound, 0.5).stiffness, 1e-12);
  const std::vector<double> bounds = segment_bounds(*study.model, study.setting);
  EXPECT_TRUE(std::ranges::any_of(
      bounds, [](double bound) { return std::fabs(bound - 0.65 / 20.0) < 1e-12; }));
}

TEST(MeasuredGear, DamageThatCannotBeIsRefused) {
  const auto refusal = [](const std::string& keys, const std::string& numbers) {
    try {
      measured_study(kOneSine + keys + "gear_damage_file = 'd.csv'\n",
                     held_table("d.csv", numbers));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal("damage = [0.3, 0]\n", "0, 0.2\n1, 0.4\n"), "accepted");
  EXPECT_THAT(refusal("damage = 0.3\n", "0, 0.2\n1, 0.4\n"), HasSubstr("keep one"));
  EXPECT_THAT(refusal("", "0, 0.2\n1, 1.5\n"), HasSubstr("has 1.5 at 1; a share"));
  EXPECT_THAT(refusal("", "0, -0.2\n1, 0.5\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(refusal("helix_angle_deg = 10\nface_width_mm = 10\n", "0, 0.2\n"),
              HasSubstr("is for spur gears"));
  std::string many;
  for (int i = 0; i <= 100; ++i) many += fmt::format("{}, 0.1\n", i / 100.0);
  EXPECT_THAT(refusal("", many), HasSubstr("101 points; at most 100"));
}

// A gear pair in SI units with this torque, by SciPy's DOP853 with rtol = 1e-9, whose integration
// ends where pairs enter and leave: over the sixth turn at 3000 rpm the largest force is 6735.36 N
// and its standard deviation 909.005 N, where the mean torque makes 2643.64 N. The largest one was
// looked for at 400 places between two breaks; sums over these, which miss half a place at each
// jump, leave 2e-4 of the deviation.
TEST(MeasuredGear, ATorqueThatSwingsDrivesAsAnIndependentProgramSays) {
  std::string numbers = "degree, torque (N m)\n";
  for (int degree = 0; degree < 360; degree += 5) {
    const double angle = degree * std::numbers::pi / 180.0;
    numbers += fmt::format("{}, {:.10f}\n", degree,
                           59.0 + 25.0 * std::sin(angle) + 12.0 * std::sin(2.0 * angle + 0.5) +
                               6.0 * std::cos(6.0 * angle));
  }
  const SweepResult result =
      run("[gear]\nteeth = [19, 61]\nmodule_mm = 2.5\ninertia_kg_mm2 = [98, 10000]\n"
          "mass_kg = [0.35, 3.6]\nbearing_stiffness_N_per_mm = 200000\n"
          "bearing_damping_N_s_per_mm = 2\nmesh_damping_ratio = 0.07\nhalf_backlash_mm = 0.0625\n"
          "mesh_stiffness_N_per_m = 4.9e8\ncontact_ratio = 1.6\ntransmission_error_um = 5\n"
          "torque_file = 't.csv'\n" +
          held_table("t.csv", numbers) +
          "[parameters]\nmu = 0\n[[axes]]\nname = 'pinion_speed_rpm'\nvalues = [3000]\n"
          "[integrate]\nsettle = 5\nrecord = 1\nmax_step = 0.02\nstop = 'never'\n"
          "[observe]\nquantities = ['dmf_max', 'dmf_std', 'dmf_mean']\n");
  const double unit = result.study.scales.k0 * result.study.scales.b_n;
  EXPECT_NEAR(unit * map_of(result, "dmf_max").front(), 6735.36, 2.0);
  EXPECT_NEAR(unit * map_of(result, "dmf_std").front(), 909.005, 0.5);
  // What swings changes the mean by nothing.
  EXPECT_NEAR(unit * map_of(result, "dmf_mean").front(), 2643.64, 1.0);
}

}  // namespace
}  // namespace gearsweep::testing
