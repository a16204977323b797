// What scatters of gears as built, against drawings that have it and against linear responses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "study/usual_tolerances.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using Complex = std::complex<double>;

// A pair of random numbers that keeps contact. stiffness: N/m.
std::string random_pair(std::mt19937_64* random, double stiffness, const std::string& more) {
  const auto about = [&](double value) {
    return value * std::uniform_real_distribution<double>(0.7, 1.4)(*random);
  };
  std::string text = fmt::format(
      "[model]\nname = 'gear5'\nbacklash = 'dynamic'\n[parameters]\nmu = {}\n[gear]\nteeth = [19, "
      "61]\nmodule_mm = 2.5\ninertia_kg_mm2 = [{}, {}]\nmass_kg = [{}, {}]\n",
      about(0.04), about(120.0), about(9000.0), about(0.4), about(3.5));
  text += fmt::format(
      "bearing_stiffness_N_per_mm = [{}, {}, {}, {}]\nbearing_damping_N_s_per_mm = {}\n"
      "half_backlash_mm = {}\ntorque_N_m = {}\ntransmission_error_um = [{}, {}]\n",
      about(2e5), about(2e5), about(3e5), about(2e5), about(2.0), about(0.06), about(80.0),
      about(3.0), about(0.5));
  return text + fmt::format("mesh_stiffness_N_per_m = {}\n", stiffness) + more;
}

// Fine steps: what is compared takes other ones, as its units of time are others.
const std::string kFine =
    "[[axes]]\nname = 'pinion_speed_rpm'\nvalues = [2500, 6100]\n[integrate]\nsettle = 300\n"
    "record = 4\nsteps_per_period = 512\nstop = 'never'\n[observe]\nquantities = ['dmf_max', "
    "'dmf_min', 'dte_peak_to_peak', 'bearing_p_max', 'bearing_g_max']\n";

// In SI units, whatever the drawing counts in.
std::vector<double> in_si(const SweepResult& result) {
  const Scales& scales = result.study.scales;
  std::vector<double> all;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const bool is_length = result.study.selection.quantities[i].unit == "b_n";
    for (const double value : result.values[i]) {
      all.push_back(value * scales.b_n * (is_length ? 1.0 : scales.k0));
    }
  }
  return all;
}

// With the factor f the motion is that of a drawing with f times the stiffness; the damping ratio
// is of the mesh as it is, in both.
TEST(StiffnessFactor, IsADrawingWithSoMuchOfTheStiffness) {
  std::mt19937_64 random(7);
  for (const double factor : {0.55, 0.8, 1.3}) {
    for (const std::string more : {"mesh_damping_ratio = 0.08\ntooth_entry = 'gradual'\n",
                                   "mesh_damping_N_s_per_mm = 0.9\n"}) {
      const std::mt19937_64 same = random;
      const double stiffness = 3e8;
      std::mt19937_64 first = same;
      const std::vector<double> with_factor = in_si(run(
          random_pair(&first, stiffness, more + fmt::format("stiffness_factor = {}\n", factor)) +
          kFine));
      random = same;
      const std::vector<double> drawn =
          in_si(run(random_pair(&random, factor * stiffness, more) + kFine));
      const std::vector<double> without = in_si(run([&] {
        std::mt19937_64 third = same;
        return random_pair(&third, stiffness, more);
      }() + kFine));
      ASSERT_EQ(with_factor.size(), drawn.size());
      double most = 0.0;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        // The classical method of fourth order, largest values at the steps; friction jumps.
        EXPECT_NEAR(with_factor[i], drawn[i], 1e-5 * std::abs(drawn[i]) + 1e-11) << factor << i;
        most = std::max(most, std::abs(without[i] / drawn[i] - 1.0));
      }
      EXPECT_GT(most, 0.05);  // the factor matters
    }
  }
}

// The motion of gear5 about its equilibrium while teeth touch, without friction, under an error of
// amplitude e at the frequency w: x = Re(X exp(i w tau)), by the equations of motion.
Eigen::Vector3cd linear_response(const Study& study, double w, double e) {
  const auto of = [&](const char* name) {
    return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
  };
  const double zeta = of("zeta"), m1 = of("m1"), m2 = of("m2");
  const Complex z(0.0, w), mesh = of("stiffness_factor") + 4.0 * zeta * z;
  const Complex pinion = z * z + m1 * (2.0 * zeta * of("c2") * z + of("k2"));
  const Complex gear = z * z + m2 * (2.0 * zeta * of("c4") * z + of("k4"));
  Eigen::Matrix3cd matrix;
  matrix << z * z + mesh, -mesh, mesh,             //
      -m1 * mesh, pinion + m1 * mesh, -m1 * mesh,  //
      m2 * mesh, -m2 * mesh, gear + m2 * mesh;
  return matrix.partialPivLu().solve(Eigen::Vector3cd(Complex(0.0, -e * w * w), 0.0, 0.0));
}

const std::string kEccentric =
    "[model]\nname = 'gear5'\nstiffness = 'fourier'\n[parameters]\nkappa = 0.0\nmu = 0.0\n[gear]\n"
    "teeth = [19, 61]\nmodule_mm = 2.5\ninertia_kg_mm2 = [120, 9000]\nmass_kg = [0.4, 3.5]\n"
    "bearing_stiffness_N_per_mm = 2e5\nbearing_damping_N_s_per_mm = 2\nmesh_damping_ratio = 0.2\n"
    "half_backlash_mm = 0.06\nmesh_stiffness_N_per_m = 3e8\ntorque_N_m = 80\n"
    "transmission_error_um = 3\nrunout_um = [4, 0]\n[[axes]]\nname = 'pinion_speed_rpm'\n"
    "values = [9000]\n[integrate]\nsettle = 30\nrecord = 2\nmax_step = 0.1\n[observe]\n"
    "orders = [0.05263157894736842, 1]\n"
    "quantities = ['x1_order_0_05263157894736842_amplitude', 'x1_order_1_amplitude']\n";

// The pinion's runout comes once per turn, at 1/19 of the mesh frequency; each gear has its own.
TEST(Runout, IsDrawnOfOneGear) {
  const SweepResult result =
      run(kEccentric +
          "[uncertain]\nsamples = 6\nkeep = true\nstart = 'nominal'\npinion_runout_um = "
          "{distribution = 'uniform', from = 1, to = 9}\n"
          "pinion_runout_phase_deg = {distribution = 'uniform', from = 0, to = 360}\n");
  const Study& study = result.study;
  const double w = study.axes[0].columns[0].values[0];
  const std::vector<double>& once = map_of(result, "x1_order_0_05263157894736842_amplitude_draws");
  const std::vector<double>& mesh = map_of(result, "x1_order_1_amplitude_draws");
  const std::vector<UncertainParameter>& drawn = study.uncertain.parameters;
  ASSERT_EQ(drawn.size(), 2U);
  const bool is_first = drawn[0].draws.name == "pinion_runout_um";
  for (std::size_t draw = 0; draw < 6; ++draw) {
    const double runout = drawn[is_first ? 0 : 1].draws.values[draw] * 1e-6 / study.scales.b_n;
    const double expected = std::abs(linear_response(study, w / 19.0, runout)[0]);
    EXPECT_NEAR(once[draw], expected, 1e-6 * expected);
    const double by_mesh = std::abs(linear_response(study, w, 3e-6 / study.scales.b_n)[0]);
    EXPECT_NEAR(mesh[draw], by_mesh, 1e-4 * by_mesh);  // fourth order in a step of 0.1
  }
}

// One order by its name is that order of all.
TEST(Orders, OneOfThemIsThatOfAll) {
  const SweepResult result = run(
      "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n[integrate]\nsettle = 100\nrecord = 4\n"
      "[observe]\norders = [0.5, 1, 2]\nquantities = ['dmf_order_amplitude', 'dmf_order_phase', "
      "'dmf_order_2_phase', 'dmf_order_1_amplitude', 'dmf_order_0_5_amplitude']\n");
  const std::vector<double>& all = map_of(result, "dmf_order_amplitude");
  for (std::size_t point = 0; point < 2; ++point) {
    EXPECT_EQ(map_of(result, "dmf_order_1_amplitude")[point], all[3 * point + 1]);
    EXPECT_EQ(map_of(result, "dmf_order_0_5_amplitude")[point], all[3 * point]);
    EXPECT_EQ(map_of(result, "dmf_order_2_phase")[point],
              map_of(result, "dmf_order_phase")[3 * point + 2]);
  }
}

// What the order is of draws of a linear oscillator is its amplitude, whose closed form is known.
TEST(Orders, HaveBandsOfTheirDraws) {
  const SweepResult result = run(
      "[model]\ntext = '''\n[model]\nname = \"linear\"\n[states]\nx = {}\nv = {}\n[parameters]\n"
      "w = {value = 0.5, min = 0.1}\nF = 1.0\n[equations]\nx = \"v\"\n"
      "v = \"-0.2*v - x + F*cos(phase)\"\n[forcing]\nperiod = \"2*pi/w\"\n'''\n"
      "[[axes]]\nname = 'w'\nvalues = [0.5, 0.9]\n[integrate]\nmax_step = 0.02\n"
      "[observe]\nquantities = ['x_order_1_amplitude', 'x_order_2_amplitude']\n"
      "[uncertain]\nsamples = 30\nkeep = true\npercentiles = [50]\n"
      "F = {distribution = 'uniform', from = 0.8, to = 1.2}\n");
  const std::vector<double>& forces = result.study.uncertain.parameters[0].draws.values;
  for (std::size_t point = 0; point < 2; ++point) {
    const double w = point == 0 ? 0.5 : 0.9;
    std::vector<double> exact;
    for (std::size_t draw = 0; draw < 30; ++draw) {
      exact.push_back(forces[draw] / std::hypot(1.0 - w * w, 0.2 * w));
      EXPECT_NEAR(map_of(result, "x_order_1_amplitude_draws")[30 * point + draw], exact.back(),
                  1e-6);
      EXPECT_NEAR(map_of(result, "x_order_2_amplitude_draws")[30 * point + draw], 0.0, 1e-6);
    }
    std::ranges::sort(exact);
    EXPECT_NEAR(map_of(result, "x_order_1_amplitude_p50")[point], 0.5 * (exact[14] + exact[15]),
                1e-6);
  }
}

}  // namespace
}  // namespace gearsweep::testing
