// Flank tolerances against numbers of other programs for ISO 1328-1:2013, and the standard's
// ranges.
#include "gear/tolerance_class.hpp"

#include <gtest/gtest.h>

namespace gearsweep::testing {
namespace {

// Module 3 mm, 40 teeth, class 6: f_pT, F_pT and F_alphaT as the tests of a public program for the
// standard have them, counted from the same formulas by other hands: 8.94, 28.80 and 12 um.
TEST(ToleranceClass, AGearOfClass6HasTheTolerancesOfAnotherProgram) {
  const auto um = flank_tolerances({120.0, 3.0, 6});
  ASSERT_TRUE(um);
  EXPECT_EQ(um->single_pitch, 9.0);
  EXPECT_EQ(um->total_pitch, 29.0);
  EXPECT_EQ(um->profile_total, 12.0);
}

// By hand for d = 100 mm, m_n = 2 mm and class 5, where the factor is 1: f_pT = 0.1 + 0.8 + 5,
// F_pT = 0.2 + 5.5 + 1.4 + 12, f_Halpha = 0.8 + 0.1 + 4, f_falpha = 1.1 + 5, F_r = 0.9 19.1.
TEST(ToleranceClass, ValuesAreRoundedToOneHalfAndATenthMicrometre) {
  const auto um = flank_tolerances({100.0, 2.0, 5});
  ASSERT_TRUE(um);
  EXPECT_EQ(um->single_pitch, 6.0);
  EXPECT_EQ(um->total_pitch, 19.0);
  EXPECT_EQ(um->profile_slope, 4.9);
  EXPECT_EQ(um->profile_form, 6.0);
  EXPECT_EQ(um->profile_total, 8.0);
  EXPECT_EQ(um->runout, 17.0);
}

TEST(ToleranceClass, OutsideOfTheStandardThereAreNoTolerances) {
  EXPECT_FALSE(flank_tolerances({4.9, 1.0, 6}));
  EXPECT_FALSE(flank_tolerances({100.0, 0.4, 6}));
  EXPECT_FALSE(flank_tolerances({100.0, 2.0, 0}));
  EXPECT_FALSE(flank_tolerances({100.0, 2.0, 12}));
}

}  // namespace
}  // namespace gearsweep::testing
