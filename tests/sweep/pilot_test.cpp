// The step that integrate.tolerance finds, judged by an oscillator whose orbit is known.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "model/error.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

const std::string kOscillator =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.1\nlinear = 2.0\ncubic = 0.0\n"
    "amplitude = 0.7\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.4\ncount = 41\n"
    "[observe]\nquantities = ['x_rms']\n";

// rms of the orbit of x'' + 0.1 x' + 2 x = 0.7 sin(omega t).
double exact_rms(double omega) {
  const std::complex<double> stiffness(2.0 - omega * omega, 0.1 * omega);
  return 0.7 / std::abs(stiffness) / std::numbers::sqrt2;
}

double max_error(const SweepResult& result) {
  double error = 0.0;
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    const double exact = exact_rms(result.study.axes[0].values[i]);
    error = std::max(error, std::abs(map_of(result, "x_rms")[i] - exact) / exact);
  }
  return error;
}

class PilotTolerance : public ::testing::TestWithParam<const char*> {};

TEST_P(PilotTolerance, IsKeptAtEveryPointOfASmoothSystem) {
  const double tolerance = std::stod(GetParam());
  const SweepResult result = run(kOscillator, {std::string("integrate.tolerance=") + GetParam()});
  ASSERT_TRUE(result.pilot.has_value());
  EXPECT_EQ(result.study.integrate.max_step, result.pilot->step);
  EXPECT_EQ(result.pilot->points, 12U);
  EXPECT_LE(result.pilot->error, tolerance);
  EXPECT_LE(max_error(result), tolerance);
  // The next longer step would not have done: its error is 16 times this one's, or the longest
  // step was good enough.
  EXPECT_TRUE(result.pilot->step == 0.2 || result.pilot->error > tolerance / 32.0);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, PilotTolerance, ::testing::Values("1e-3", "1e-5", "1e-8"));

// Motion on one flank does not know the backlash (model.md, exact test 4), and neither does the
// step that it needs, though the backlash is the offset of all its states.
TEST(Pilot, DoesNotKnowTheOffsetOfTheMotion) {
  const auto pilot = [](double b) {
    return run(fmt::format("[model]\npreset = 'consistent'\n[parameters]\nF1 = 0.5\ne0 = 0.1\nb = "
                           "{}\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.2\ncount = 6\n"
                           "[observe]\nquantities = ['x1_rms']\n[integrate]\ntolerance = 1e-5\n",
                           b))
        .pilot.value();
  };
  const PilotFindings near = pilot(1.0), far = pilot(300.0);
  EXPECT_EQ(near.points, 6U);
  EXPECT_EQ(far.points, 6U);
  EXPECT_EQ(far.step, near.step);
  EXPECT_NEAR(far.error, near.error, 1e-3 * near.error);
}

std::string refusal(const std::string& toml, const std::vector<std::string>& overrides) {
  try {
    run(toml, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Pilot, RefusesATwofoldDemand) {
  EXPECT_THAT(refusal(kOscillator, {"integrate.tolerance=1e-4", "integrate.max_step=0.01"}),
              HasSubstr("not both"));
}

TEST(Pilot, SaysWhatFp32CannotDo) {
  EXPECT_THAT(refusal(kOscillator, {"integrate.tolerance=1e-9", "integrate.precision=fp32"}),
              HasSubstr("fp32 has no more digits"));
}

TEST(Pilot, SaysThatChaosTellsNothing) {
  EXPECT_THAT(refusal("[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [28.0, 29.0]\n"
                      "[integrate]\nsettle = 40\n",
                      {"integrate.tolerance=1e-4"}),
              HasSubstr("arrive on a periodic orbit"));
}

}  // namespace
}  // namespace gearsweep::testing
