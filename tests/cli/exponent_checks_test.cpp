// What the summary says of Lyapunov spectra that it can judge by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json checks_of(const Folder& folder, const std::string& words) {
  const Outcome outcome = gearsweep(folder, "run study.toml -o out.nc --json " + words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out).value("exponent_checks", nlohmann::json());
}

// Lorenz' field has the divergence -(sigma + 1 + beta) everywhere (Lorenz 1963). At rho = 0.5 the
// motion comes to rest, and no exponent is 0.
TEST(ExponentChecks, AreOfTheSumAndOfTheShiftInTime) {
  const Folder folder;
  folder.write("study.toml",
               "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [0.5, 28.0, 60.0]\n"
               "[observe]\nquantities = ['lyapunov_spectrum']\n");
  const nlohmann::json fine = checks_of(folder, "--set integrate.max_step=0.005");
  EXPECT_DOUBLE_EQ(fine["divergence"], -(10.0 + 1.0 + 8.0 / 3.0));
  EXPECT_LT(fine["sum_off"], 1e-5);
  EXPECT_EQ(fine["positive"], 2);
  EXPECT_EQ(fine["positive_without_zero"], 0);
  const nlohmann::json coarse = checks_of(folder, "--set integrate.max_step=0.15 --restart");
  EXPECT_GT(coarse["sum_off"], 0.1);

  const Outcome told = gearsweep(folder, "run study.toml -o told.nc --set integrate.max_step=0.15");
  EXPECT_THAT(told.err + told.out, HasSubstr("spectra sum to the field's divergence, -13.6667"));
  EXPECT_THAT(told.err + told.out, HasSubstr("shorter steps"));
}

// The sum of x'' = -0.2 x' - x^3 + 5 cos(t) is -0.2; nothing need be 0.
TEST(ExponentChecks, OfAForcedMotionAreOfTheSumAlone) {
  const Folder folder;
  folder.write("study.toml",
               "[model]\nname = 'duffing'\npreset = 'ueda'\n[parameters]\ndamping = 0.2\n[[axes]]\n"
               "name = 'amplitude'\nvalues = [5.0]\n[observe]\n"
               "quantities = ['lyapunov_spectrum']\n");
  const nlohmann::json checks = checks_of(folder, "");
  EXPECT_DOUBLE_EQ(checks["divergence"], -0.2);
  EXPECT_LT(checks["sum_off"], 1e-4);
  EXPECT_FALSE(checks.contains("positive"));
}

// Rounding of a sum that is 0 is no sign of long steps.
TEST(ExponentChecks, AConservativeFieldNeedsNoShorterSteps) {
  const Folder folder;
  folder.write("study.toml",
               "[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\ndamping = 0.0\n"
               "amplitude = 0.3\n[[axes]]\nname = 'x'\nvalues = [0.1]\n[observe]\n"
               "quantities = ['lyapunov_spectrum']\n");
  const Outcome told = gearsweep(folder, "run study.toml -o out.nc");
  EXPECT_THAT(told.err + told.out, HasSubstr("spectra sum to the field's divergence, 0"));
  EXPECT_THAT(told.err + told.out, Not(HasSubstr("shorter steps")));
}

// Its divergence is a + x - c, which changes along the motion.
TEST(ExponentChecks, SayNothingOfASumThatTheStateChanges) {
  const Folder folder;
  folder.write("study.toml",
               "[model]\nname = 'rossler'\n[[axes]]\nname = 'c'\nvalues = [5.7]\n[observe]\n"
               "quantities = ['lyapunov_spectrum']\n");
  const nlohmann::json checks = checks_of(folder, "");
  EXPECT_FALSE(checks.contains("divergence"));
  EXPECT_EQ(checks["positive_without_zero"], 0);
}

}  // namespace
}  // namespace gearsweep::testing
