// Gears that turn slowly carry their load and no more.
#include <gtest/gtest.h>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// The load factor of the paper's gears at 50 rpm, without friction and transmission error.
double load_factor(const std::string& of_drawing) {
  return map_of(run("[parameters]\nmu = 0.0\n[gear]\nteeth = [40, 40]\nmodule_mm = 3\n"
                    "inertia_kg_mm2 = 2230\nmass_kg = 1\nbearing_stiffness_N_per_mm = 3e5\n"
                    "bearing_damping_N_s_per_mm = 1.4\nmesh_damping_N_s_per_mm = 0.7\n"
                    "half_backlash_mm = 0.05\nmesh_stiffness_N_per_m = 2.174e8\n"
                    "torque_N_m = 61\ntransmission_error_um = 0\n" +
                    of_drawing +
                    "[[axes]]\nname = 'pinion_speed_rpm'\nvalues = [50]\n[integrate]\n"
                    "engine = 'reference'\nsettle = 2\nrecord = 1\n[observe]\n"
                    "quantities = ['dynamic_load_factor']\n"),
                "dynamic_load_factor")[0];
}

// The force follows the stiffness where that jumps, as a deflection cannot.
TEST(SlowGears, CarryTheirLoadAloneWhereTeethTakeItUpGradually) {
  EXPECT_GT(load_factor(""), 1.3);
  const double gradual = load_factor("tooth_entry = 'gradual'\n");
  EXPECT_GE(gradual, 0.998);  // its damper carries a part
  EXPECT_LT(gradual, 1.01);
}

}  // namespace
}  // namespace gearsweep::testing
