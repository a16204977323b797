// What one dimensionless unit is in SI units.
#include "result/si_units.hpp"

#include <gtest/gtest.h>

namespace gearsweep {
namespace {

TEST(SiUnits, APowerIsAForceTimesAVelocity) {
  const Scales scales = {1000.0, 2e-5, 1e8, 250.0};
  const SiUnit force = si_unit("k0 b_n", scales);
  const SiUnit speed = si_unit("b_n varpi", scales);
  const SiUnit power = si_unit("k0 b_n^2 varpi", scales);
  EXPECT_EQ(power.name, "W");
  EXPECT_DOUBLE_EQ(power.scale, force.scale * speed.scale);
  EXPECT_EQ(shown_unit("k0 b_n^2 varpi", scales).name, "W");
  EXPECT_EQ(si_unit("k0 b_n^2 varpi", {}).scale, 0.0);
}

}  // namespace
}  // namespace gearsweep
