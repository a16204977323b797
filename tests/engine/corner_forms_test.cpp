// Corners that are written with abs, clamp, min and if, beside the closed form of a motion that is
// linear between them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/exact_pieces.hpp"
#include "orbits/shooting.hpp"
#include "study/model_file.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kForce = 1.1;
const std::vector<double> kOmegas = {0.61, 0.67, 0.73, 0.79, 0.85, 0.91, 0.97, 1.03};

const char* const kModel =
    "[model]\nname = \"corners\"\n[states]\nx = {}\nv = {}\n[parameters]\nomega = 0.8\nF = 1.1\n"
    "[constants]\nspring = \"0.6*x + 0.4*abs(x) + clamp(x, -0.3, 0.5) - 2*min(0.2 - x, 0)\"\n"
    "hard = \"if(x > 0.7, 3*(x - 0.7), 0)\"\n[equations]\nx = \"v\"\n"
    "v = \"F*cos(phase) - 0.1*v - spring - hard\"\n[forcing]\nperiod = \"2*pi/omega\"\n";

ExactPieces closed_form(double omega) {
  const auto x_is = [](double at) { return Limit{Eigen::Vector2d(1.0, 0.0), at}; };
  ExactPieces exact{.omega = omega,
                    .limits = {x_is(-0.3), x_is(0.0), x_is(0.2), x_is(0.5), x_is(0.7)},
                    .field = {}};
  exact.field = [](const Sides& beyond, std::size_t) {
    LinearField field(2);
    double stiffness = 0.6 + (beyond[1] ? 0.4 : -0.4), constant = 0.0;
    if (!beyond[0]) {
      constant += 0.3;
    } else if (beyond[3]) {
      constant -= 0.5;
    } else {
      stiffness += 1.0;
    }
    if (beyond[2]) {
      stiffness += 2.0;
      constant += 0.4;
    }
    if (beyond[4]) {
      stiffness += 3.0;
      constant += 2.1;
    }
    field.slope << 0.0, 1.0, -stiffness, -0.1;
    field.constant[1] = constant;
    field.cosine[1] = kForce;
    return field;
  };
  return exact;
}

// Periods from the start at x = 0.9.
constexpr std::size_t kPeriods = 3;

Eigen::VectorXd exact_end(double omega) {
  Eigen::VectorXd state = Eigen::Vector2d(0.9, 0.0);
  for (std::size_t i = 0; i < kPeriods; ++i) state = closed_form(omega).advance(state).state;
  return state;
}

// Mean error of x over the omegas.
double error_of(std::size_t steps, const std::string& engine) {
  std::string omegas;
  for (const double omega : kOmegas) omegas += fmt::format("{},", omega);
  const SweepResult result = run(fmt::format(
      "[model]\ntext = '''\n{}'''\n[[axes]]\nname = 'omega'\nvalues = [{}]\n[initial]\n"
      "policy = 'fixed'\nstate = {{x = 0.9}}\n[integrate]\nengine = '{}'\nsettle = 0\nrecord = {}\n"
      "extend = 1\nstop = 'never'\nsteps_per_period = {}\n[observe]\nquantities = ['poincare', "
      "'x_rms']\n",
      kModel, omegas, engine, kPeriods, steps));
  double sum = 0.0;
  for (std::size_t i = 0; i < kOmegas.size(); ++i) {
    sum += std::fabs(samples_of(result, i, 0).back() - exact_end(kOmegas[i])[0]);
  }
  return sum / static_cast<double>(kOmegas.size());
}

TEST(CornerForms, LeaveAnErrorOfFourthOrder) {
  const double coarse = error_of(64, "opencl"), fine = error_of(512, "opencl");
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.5) << coarse << ' ' << fine;
  EXPECT_LT(fine, 3e-7);
}

TEST(CornerForms, AreCorrectedByTheReferenceEngine) { EXPECT_LT(error_of(512, "reference"), 3e-7); }

// Newton's method and the multipliers cut their steps at corners.
TEST(CornerForms, HaveTheMultipliersOfTheClosedForm) {
  const auto model = read_model_text(kModel, "corners.toml");
  ModelSetting setting = model->default_setting();
  for (const double omega : {1.6, 2.1}) {  // orbits of two periods
    setting.parameters[0] = omega;
    const PeriodMap map(*model, setting, 512);
    const Eigen::VectorXd start = Eigen::Vector2d(0.1, 0.0);
    const Orbit found = shoot(map, map.advance(start, 300).value(), 2).value();
    const ExactPieces exact = closed_form(omega);
    const ExactPieces::Image first = exact.advance(found.state);
    const ExactPieces::Image second = exact.advance(first.state);
    const Eigen::MatrixXd monodromy = second.monodromy * first.monodromy;
    EXPECT_GT(first.crossings, 1U);
    EXPECT_LT((found.state - second.state).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR((found.multipliers[0] * found.multipliers[1]).real(), monodromy.determinant(),
                1e-6);
    EXPECT_NEAR((found.multipliers[0] + found.multipliers[1]).real(), monodromy.trace(), 1e-5);
  }
}

}  // namespace
}  // namespace gearsweep::testing
