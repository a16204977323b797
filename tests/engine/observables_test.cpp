// Observables of the kernel against the reference engine, which has its own code for each; and what
// becomes of a point that diverges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>

#include "support/bits.hpp"
#include "support/eigenvalues.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::Each;

// Every quantity of every state and signal, and the contact regime.
std::string all_quantities() {
  std::string list =
      "'contact_drive', 'contact_gap', 'contact_back', 'contact_wedged', 'contact_losses', "
      "'contact_class', 'poincare'";
  for (const auto& channels : {gear5().states, gear5().signals}) {
    for (const ChannelInfo& channel : channels) {
      for (const char* suffix : {"_min", "_max", "_peak_to_peak", "_mean", "_rms", "_std"}) {
        list += ", '" + channel.name + suffix + "'";
      }
    }
  }
  return list;
}

// Both engines do the same steps, but round differently. The runs last less than 120 units of time,
// in which even chaotic motion (exponent 0.1) multiplies 1e-15 by less than 2e5: 1e-9 holds with
// room, and no motion has to be left out.
constexpr double kTolerance = 1e-9;

void expect_engines_agree(const std::string& toml, const std::vector<double>& classes) {
  const SweepResult kernel = run(toml);
  const SweepResult reference = run(toml, {"integrate.engine='reference'"});
  EXPECT_EQ(kernel.status, reference.status);
  EXPECT_THAT(kernel.status, Each(0));
  for (const Quantity& quantity : kernel.study.selection.quantities) {
    const std::vector<double>& a = map_of(kernel, quantity.name);
    const std::vector<double>& b = map_of(reference, quantity.name);
    const bool counted = quantity.name == "contact_losses" || quantity.name == "contact_class";
    for (std::size_t point = 0; point < a.size(); ++point) {
      EXPECT_NEAR(a[point], b[point], counted ? 0.0 : kTolerance)
          << quantity.name << ", point " << point;
    }
  }
  ASSERT_EQ(kernel.samples.size(), reference.samples.size());
  for (std::size_t i = 0; i < kernel.samples.size(); ++i) {
    EXPECT_NEAR(kernel.samples[i], reference.samples[i], kTolerance);
  }
  for (const double contact_class : classes) {
    EXPECT_THAT(map_of(kernel, "contact_class"), Contains(contact_class));
  }
  for (std::size_t point = 0; point < kernel.study.points(); ++point) {
    const double drive = map_of(kernel, "contact_drive")[point];
    const double back = map_of(kernel, "contact_back")[point];
    const double wedged = map_of(kernel, "contact_wedged")[point];
    EXPECT_NEAR(drive + map_of(kernel, "contact_gap")[point] + back + wedged, 1.0, 1e-12);
    const double contact_class = map_of(kernel, "contact_class")[point];
    EXPECT_EQ(contact_class == 3.0, map_of(kernel, "backlash_min")[point] < 0.0);
    if (contact_class < 3.0) {
      EXPECT_EQ(wedged, 0.0);
      EXPECT_EQ(contact_class == 2.0, drive > 0.0 && back > 0.0);
    }
    if (contact_class == 0.0) {
      EXPECT_EQ(map_of(kernel, "contact_losses")[point], 0.0);
    }
  }
}

const std::string kObserveAll =
    "[observe]\npoincare = ['x1', 'x4', 'v1']\nquantities = [" + all_quantities() + "]\n";
const std::string kRest =
    "[[axes]]\nname = 'b'\nvalues = [0.05, 0.4, 1.0]\n[integrate]\nsettle = 6\nrecord = 5\n"
    "max_step = 0.02\n" +
    kObserveAll;

TEST(Observables, AgreeWithTheReferenceEngine) {
  expect_engines_agree(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\n"
      "values = [0.7, 0.9, 1.3, 1.7]\n" +
          kRest,
      {0.0, 1.0, 2.0});
}

TEST(Observables, AgreeWithTheReferenceEngineForDynamicBacklash) {
  expect_engines_agree(
      "[model]\nbacklash = 'dynamic'\n[parameters]\nomega = 1.3\n[[axes]]\n"
      "name = 'e0'\nvalues = [0.02, 0.2, 0.6]\n" +
          kRest,
      {0.0, 1.0, 2.0, 3.0});
}

// Any step, from one that sees each crossing to one in which several limits are crossed at once.
TEST(Observables, FractionsOfContactAddUpToOne) {
  for (const std::string law : {"constant", "dynamic"}) {
    for (const std::string steps : {"12", "32", "128"}) {
      expect_engines_agree(
          "[model]\npreset = 'coarse'\nbacklash = '" + law +
              "'\n[[axes]]\nname = 'omega'\nfrom = 0.61\nto = 1.77\ncount = 7\n[[axes]]\n"
              "name = 'b'\nvalues = [0.0, 0.003, 0.03, 0.1, 0.25]\n[integrate]\nsettle = 4\n"
              "record = 3\nsteps_per_period = " +
              steps + "\n[observe]\nquantities = ['backlash_min', 'contact_drive', " +
              "'contact_gap', 'contact_back', 'contact_wedged', 'contact_losses', "
              "'contact_class']\n",
          {law == "dynamic" ? 3.0 : 2.0});
    }
  }
}

// The recorded signals are what the equations say: with constant backlash b' is b, and D and the
// force are those of the states. With the kernels of the comparison above.
TEST(Observables, SignalsAreThoseOfTheStates) {
  const SweepResult result =
      run("[model]\npreset = 'consistent'\n[[axes]]\nname = 'b'\nvalues = [0.5, 1.0]\n"
          "[integrate]\nsettle = 200\nrecord = 4\nstop = 'never'\n" +
          kObserveAll);
  for (std::size_t point = 0; point < 2; ++point) {
    const auto value = [&](const char* quantity) { return map_of(result, quantity)[point]; };
    EXPECT_EQ(value("backlash_min"), result.study.axes[0].values[point]);
    EXPECT_EQ(value("backlash_max"), result.study.axes[0].values[point]);
    // The mean is linear and rms^2 = mean^2 + std^2, but for rounding.
    EXPECT_NEAR(value("deflection_mean"), value("x1_mean") - value("x3_mean") + value("x5_mean"),
                1e-13);
    EXPECT_NEAR(std::pow(value("x1_rms"), 2),
                std::pow(value("x1_mean"), 2) + std::pow(value("x1_std"), 2), 1e-13);
  }
}

// Where nothing moves the force is the load; without a load there is no factor.
TEST(Observables, DynamicLoadFactorIsTheLargestForceOverTheLoad) {
  const SweepResult still = run(
      "[model]\nstiffness = 'fourier'\n[parameters]\nkappa = 0.0\nmu = 0.0\ne0 = 0.0\n[[axes]]\n"
      "name = 'F1'\nvalues = [0.0, 0.1, 0.3]\n[integrate]\nsettle = 100\nrecord = 1\nstop = "
      "'never'\n"
      "[observe]\nquantities = ['dynamic_load_factor', 'dmf_max', 'bearing_p_max', "
      "'bearing_g_max']\n");
  const std::vector<double>& factor = map_of(still, "dynamic_load_factor");
  EXPECT_TRUE(std::isnan(factor[0]));
  for (const std::size_t point : {1U, 2U}) {
    EXPECT_NEAR(factor[point], 1.0, 1e-12);
    // The shafts hold what the teeth press with.
    EXPECT_NEAR(map_of(still, "bearing_p_max")[point], map_of(still, "dmf_max")[point], 1e-12);
    EXPECT_NEAR(map_of(still, "bearing_g_max")[point], map_of(still, "dmf_max")[point], 1e-12);
  }
  const SweepResult gear1 =
      run("[model]\nname = 'gear1'\n[[axes]]\nname = 'Fm'\nvalues = [0.1, 0.2]\n[integrate]\n"
          "settle = 20\nrecord = 2\nstop = 'never'\n[observe]\nquantities = ['dmf_max', "
          "'dynamic_load_factor', "
          "'dmf_min', 'dmf_peak_to_peak']\n");
  for (const std::size_t point : {0U, 1U}) {
    EXPECT_EQ(map_of(gear1, "dynamic_load_factor")[point],
              map_of(gear1, "dmf_max")[point] / gear1.study.axes[0].values[point]);
    EXPECT_EQ(map_of(gear1, "dmf_peak_to_peak")[point],
              map_of(gear1, "dmf_max")[point] - map_of(gear1, "dmf_min")[point]);
  }
}

// x1 rests near b + 0.24, and the transmission error moves it by about its own size. What fp32
// makes of that is off by about ten units in the last place, 1.5e-6 with b = 1.
TEST(Observables, HaveNoDeviationThatRoundingSwallows) {
  const std::string study =
      "[model]\npreset = 'consistent'\nstiffness = 'fourier'\n[parameters]\nkappa = 0\nmu = 0\n"
      "[[axes]]\nname = 'e0'\nvalues = [0.0, 1e-6, 1e-4, 1e-2]\n[[axes]]\nname = 'b'\n"
      "values = [1.0, 1000.0]\n[integrate]\nstop = 'never'\n"
      "[observe]\nquantities = ['x1_mean', 'x1_std', 'x2_std']\n";
  const SweepResult fp32 = run(study, {"integrate.precision=fp32"});
  const SweepResult fp64 = run(study);
  const std::vector<double>& rounded = map_of(fp32, "x1_std");
  const std::vector<double>& exact = map_of(fp64, "x1_std");
  for (const std::size_t swallowed : {0U, 1U, 4U, 5U, 6U, 7U}) {
    EXPECT_TRUE(std::isnan(rounded[swallowed])) << swallowed;
    EXPECT_LT(exact[swallowed], 1e-5 * map_of(fp64, "x1_mean")[swallowed]) << swallowed;
  }
  EXPECT_NEAR(rounded[2], exact[2], 0.1 * exact[2]);
  EXPECT_NEAR(rounded[3], exact[3], 1e-3 * exact[3]);
  // The shafts' lateral motion is exactly 0 without friction: no offset, nothing to swallow.
  EXPECT_THAT(map_of(fp32, "x2_std"), Each(0.0));
  for (std::size_t point = 0; point < 8; ++point) {
    EXPECT_NEAR(map_of(fp32, "x1_mean")[point], map_of(fp64, "x1_mean")[point],
                1e-5 * map_of(fp64, "x1_mean")[point]);
  }
}

// Undamped, in contact and with mesh stiffness 1, the printed form is unstable exactly while
// m k/(1 + sqrt(2 m))^2 < 1 < m k/(1 - sqrt(2 m))^2.
double max_growth(double m, double k) {
  ModelSetting setting = gear5().default_setting();
  set_option(&setting, "formulation", "printed");
  set_option(&setting, "stiffness", "fourier");
  for (const char* name : {"kappa", "zeta", "mu", "e0"}) set_parameter(&setting, name, 0.0);
  for (const char* name : {"m1", "m2"}) set_parameter(&setting, name, m);
  for (const char* name : {"k1", "k2", "k3", "k4"}) set_parameter(&setting, name, k);
  std::vector<double> coefs(gear5().phase_coefs.size());
  gear5().phase_coefs_at(setting, 0.3, 0.3, coefs.data());
  const std::unique_ptr<PreparedPoint> point = gear5().prepare(setting);
  const std::vector<double> rest = gear5().equilibrium(setting);
  Eigen::MatrixXd jacobian(10, 10);
  for (Eigen::Index i = 0; i < 10; ++i) {
    std::vector<double> up = rest, down = rest;
    up[static_cast<std::size_t>(i)] += 0.01;
    down[static_cast<std::size_t>(i)] -= 0.01;
    Eigen::VectorXd slope_up(10), slope_down(10);
    point->rhs(coefs.data(), up.data(), slope_up.data());
    point->rhs(coefs.data(), down.data(), slope_down.data());
    jacobian.col(i) = (slope_up - slope_down) / 0.02;
  }
  return eigenvalues_of(jacobian).real().maxCoeff();
}

// One per cent inside the limits the growth is the square root of it times a frequency, 0.01 and
// more; outside it is zero, which rounding makes some 1e-8.
// This pendulum turns over and over. Where its angle stands at phase 0 does not depend on how many
// turns it has made since the last.
TEST(Observables, SeeTheSectionOfATurningPendulumWithoutItsTurns) {
  for (const std::string engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result =
        run("[model]\nname = 'pendulum'\npreset = 'cascade'\n[[axes]]\nname = 'damping'\n"
            "values = [0.7]\n[integrate]\nsettle = 200\nrecord = 64\nstop = 'never'\n"
            "[observe]\nquantities = ['period', 'section_min', 'section_max']\n",
            {"integrate.engine='" + engine + "'"});
    ASSERT_EQ(map_of(result, "period"), (std::vector<double>{1.0}));
    const double min = map_of(result, "section_min")[0];
    EXPECT_LT(std::abs(min), std::numbers::pi);
    EXPECT_NEAR(map_of(result, "section_max")[0], min, 1e-6);
  }
}

TEST(Divergence, PrintedFormFluttersBetweenTwoStiffnesses) {
  for (const double m : {0.04, 0.3507525}) {
    const double low = std::pow(1.0 - std::sqrt(2.0 * m), 2) / m;
    const double high = std::pow(1.0 + std::sqrt(2.0 * m), 2) / m;
    EXPECT_LT(max_growth(m, 0.99 * low), 1e-6);
    EXPECT_GT(max_growth(m, 1.01 * low), 1e-3);
    EXPECT_GT(max_growth(m, 0.99 * high), 1e-3);
    EXPECT_LT(max_growth(m, 1.01 * high), 1e-6);
  }
}

const std::string kFlutter =
    "[model]\npreset = 'consistent'\nformulation = 'printed'\n[[axes]]\nname = 'm1'\n"
    "values = [0.03, 0.3507525]\n[[axes]]\nname = 'm2'\nvalues = [0.03, 0.3507525]\n"
    "[integrate]\nsettle = 50\nrecord = 10\nstop = 'never'\n[observe]\nquantities = ['x1_min', "
    "'x1_rms', "
    "'contact_drive', 'contact_losses', 'contact_class', 'dmf_max', 'poincare']\n";

// With the masses of the paper's Table 1 the printed form runs away. The point says so, has no
// number in any map, and leaves its neighbours' bits, which share its work-item, alone.
TEST(Divergence, IsDataAndDoesNotSpread) {
  for (const std::string engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const std::string choice = "integrate.engine='" + engine + "'";
    const SweepResult result = run(kFlutter, {choice, "integrate.lanes=4"});
    const SweepResult alone = run(
        kFlutter, {choice, "integrate.lanes=4", "axes.m1.values=[0.03]", "axes.m2.values=[0.03]"});
    EXPECT_EQ(result.status[0], STATUS_ok);
    EXPECT_EQ(result.status[3], STATUS_diverged);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      EXPECT_TRUE(std::isnan(result.values[i][3]));
      EXPECT_TRUE(std::isfinite(result.values[i][0]));
      EXPECT_TRUE(same_bits(result.values[i][0], alone.values[i][0]));
    }
    for (const double sample : samples_of(result, 3, 0)) EXPECT_TRUE(std::isnan(sample));
    EXPECT_EQ(different_bits(samples_of(result, 0, 0), samples_of(alone, 0, 0)), 0U);
  }
}

TEST(Divergence, IsSeenWhenItHappensWhileRecording) {
  const SweepResult result = run(kFlutter, {"integrate.settle=0", "integrate.record=60"});
  EXPECT_EQ(result.status[0], STATUS_ok);
  EXPECT_EQ(result.status[3], STATUS_diverged);
  for (const std::vector<double>& map : result.values) EXPECT_TRUE(std::isnan(map[3]));
}

}  // namespace
}  // namespace gearsweep::testing
