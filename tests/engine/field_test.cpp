// The right-hand side of gear5 as a field: where it is continuous, and its mirror image.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/outside_gear5.hpp"
#include "plan/phase_grid.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

class Field : public ::testing::Test {
 protected:
  Field() : setting_(gear5().default_setting()) {
    set_option(&setting_, "backlash", "dynamic");
    set_parameter(&setting_, "mu", 0.1);
    point_ = gear5().prepare(setting_);
  }

  std::vector<double> random_state() {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> x(10);
    for (double& value : x) value = uniform(random_);
    return x;
  }

  std::vector<double> coefs(double psi, double inside) const {
    std::vector<double> row(gear5().phase_coefs.size());
    gear5().phase_coefs_at(setting_, psi, inside, row.data());
    return row;
  }

  // Largest difference of two fields' components.
  double distance(const std::vector<double>& coefs_a, const std::vector<double>& a,
                  const std::vector<double>& coefs_b, const std::vector<double>& b) const {
    Eigen::VectorXd slope_a(10), slope_b(10);
    point_->rhs(coefs_a.data(), a.data(), slope_a.data());
    point_->rhs(coefs_b.data(), b.data(), slope_b.data());
    return (slope_a - slope_b).cwiseAbs().maxCoeff();
  }

  std::mt19937 random_{7};
  ModelSetting setting_;
  std::unique_ptr<PreparedPoint> point_;
};

// At an edge of the backlash the force is zero from either side; only its slope changes. The
// field's slope is below 2, so states 2e-9 apart have fields at most 4e-9 apart.
TEST_F(Field, IsContinuousAtTheEdgesOfTheBacklash) {
  const std::vector<double> row = coefs(0.3, 0.3);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> x = random_state();
    std::vector<double> signals(gear5().signals.size());
    point_->signals(row.data(), x.data(), signals.data());
    const double backlash = signals[signal_index(gear5(), "backlash")];
    const double edge = trial % 2 == 0 ? backlash : -backlash;
    x[0] += edge - signals[signal_index(gear5(), "deflection")];  // deflection is x1 - x3 + x5; the
                                                                  // backlash does not know x1
    std::vector<double> inner = x, outer = x, beyond = x;
    inner[0] -= std::copysign(1e-9, edge);
    outer[0] += std::copysign(1e-9, edge);
    beyond[0] += std::copysign(1e-3, edge);
    EXPECT_LT(distance(row, inner, row, outer), 4e-9);
    EXPECT_GT(distance(row, x, row, beyond), 0.5e-3);  // the force is there
  }
}

// A step of 1e-7 in phase changes the field by less than 1e-5, unless it goes across a break phase.
TEST_F(Field, JumpsAtTheBreakPhasesOnly) {
  const std::vector<double> bounds = segment_bounds(gear5(), setting_);
  ASSERT_EQ(bounds.size(), 4U);  // 0, eps - 1, eps/2, 1
  std::vector<double> x = random_state();
  x[0] = 2.5;  // on the drive flank
  x[5] = 0.3;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 5000; ++trial) {
    const double psi = uniform(random_);
    const bool near_break = std::any_of(bounds.begin(), bounds.end(),
                                        [&](double bound) { return std::abs(psi - bound) < 1e-6; });
    if (near_break) continue;
    const double next = psi + 1e-7;
    EXPECT_LT(distance(coefs(psi, psi), x, coefs(next, next), x), 1e-5) << "phase " << psi;
  }
  for (const double bound : {bounds[1], bounds[2]}) {
    const std::vector<double> before = coefs(bound, bound - 0.01);
    const std::vector<double> after = coefs(bound, bound + 0.01);
    EXPECT_GT(distance(before, x, after, x), 1e-3) << "break phase " << bound;
  }
  EXPECT_GT(distance(coefs(1.0, 0.99), x, coefs(0.0, 0.01), x), 1e-3);
}

// Reflecting the line of action (x3, x5 negated, D = x1 + x3 - x5, forces along it reversed, the
// gear's shaft on the other side in S) gives the same field, so the same trajectories. The
// equations below are the reflected ones, written out; both sides round differently: 1e-13.
TEST_F(Field, IsItsOwnMirrorImage) {
  set_parameter(&setting_, "b", 0.0);  // the drawn shafts make the backlash negative at times
  point_ = gear5().prepare(setting_);
  const OutsideGear gear(setting_);
  int wedged = 0;
  const auto value = [&](const char* name) { return parameter_of(setting_, name); };
  const double alpha = value("alpha") * std::numbers::pi / 180.0;
  const double zeta = value("zeta"), m = value("m1"), k = value("k1"), c = value("c1");
  const double A = value("A");
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> x = random_state();
    x[0] *= 3.0;  // drive flank, gap and back flank
    const double psi = 0.001 + 0.998 * trial / 500.0;
    const MeshSums s = gear.sums(psi, psi);
    const std::vector<double> y = {x[0], x[1], -x[2], x[3], -x[4], x[5], x[6], -x[7], x[8], -x[9]};
    const double D = y[0] + y[2] - y[4];
    const double rate = y[5] + y[7] - y[9];
    const double S =
        std::hypot(A * std::cos(alpha) + y[3] - y[1], y[4] + A * std::sin(alpha) - y[2]);
    const double b = value("b") + (S - A) * std::tan(alpha);
    const double f = std::max(D - b, 0.0) + std::min(D + b, 0.0);
    if (std::abs(D) < -b) ++wedged;
    const double shaft = 2.0 * m * c * zeta;
    const double along = m * (s.B * f + 4.0 * zeta * rate);
    const double across = m * (s.C * f + 2.0 * zeta * s.H * rate);
    const double forcing =
        value("e0") * value("omega") * value("omega") * std::sin(2.0 * std::numbers::pi * psi);
    const double expected[10] = {y[5],
                                 y[6],
                                 y[7],
                                 y[8],
                                 y[9],
                                 value("F1") + forcing - s.Q * f - 2.0 * zeta * s.G * rate,
                                 -shaft * y[6] - m * k * y[1] - across,
                                 -shaft * y[7] - m * k * y[2] - along,
                                 -shaft * y[8] - m * k * y[3] + across,
                                 -shaft * y[9] - m * k * y[4] + along};
    double slope[10];
    point_->rhs(coefs(psi, psi).data(), x.data(), slope);
    for (const std::size_t reflected : {2U, 4U, 7U, 9U}) slope[reflected] = -slope[reflected];
    // S - A by subtraction, as here, loses the digits of A = 2400: 2400 * 1e-16 = 3e-13.
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(slope[i], expected[i], 2e-12);
  }
  EXPECT_GT(wedged, 5);
}

}  // namespace
}  // namespace gearsweep::testing
