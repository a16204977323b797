// gear5's dynamic backlash b' = b + (S - A) tan(alpha), Eq. (20), and its derivative. The model
// takes one of two forms, by p = (S^2/A^2 - 1)/2: a series for |p| < 1/256, else a square root.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kNear = 1.0 / 256.0;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Shafts {
  double u, v;  // x4 - x2 and x3 - x5
};

class Backlash : public ::testing::Test {
 protected:
  explicit Backlash() : setting_(gear5().default_setting()) {
    set_option(&setting_, "backlash", "dynamic");
    set_parameter(&setting_, "b", 0.0);  // so that no digit of what is added to b is lost
    coefs_.resize(gear5().phase_coefs.size());
    gear5().phase_coefs_at(setting_, 0.5, 0.5, coefs_.data());
    const double alpha = 20.0 * std::numbers::pi / 180.0;
    cos_alpha_ = std::cos(alpha);
    sin_alpha_ = std::sin(alpha);
    tan_alpha_ = std::tan(alpha);
    set_centre(2400.0);
  }

  void set_centre(double A) {
    centre_ = A;
    set_parameter(&setting_, "A", A);
    point_ = gear5().prepare(setting_);
  }

  static std::vector<double> state_of(const Shafts& shafts, double x1) {
    std::vector<double> x(gear5().states.size());
    x[state_index(gear5(), "x1")] = x1;
    x[state_index(gear5(), "x3")] = shafts.v;
    x[state_index(gear5(), "x4")] = shafts.u;
    return x;
  }

  double backlash(const Shafts& shafts) const {
    std::vector<double> signals(gear5().signals.size());
    point_->signals(coefs_.data(), state_of(shafts, 0.0).data(), signals.data());
    return signals[signal_index(gear5(), "backlash")];
  }

  long double along(const Shafts& s) const {
    return cos_alpha_ * static_cast<long double>(s.u) + sin_alpha_ * static_cast<long double>(s.v);
  }

  long double p_of(const Shafts& s) const {
    const long double A = centre_, u = s.u, v = s.v;
    return along(s) / A + (u * u + v * v) / (2.0L * A * A);
  }

  // S - A = n/(S + A) with 11 more bits.
  long double exact_shift(const Shafts& s) const {
    const long double A = centre_, n = 2.0L * A * A * p_of(s);
    return n / (A + std::sqrt(A * A + n));
  }

  // What moving the shafts in u and in v each add to S - A, signs aside: where one undoes the
  // other, the sum keeps the rounding of its terms.
  double terms(const Shafts& s) const {
    const auto term = [&](double moved, double direction) {
      return std::abs(moved) * (direction + std::abs(moved) / (2.0 * centre_));
    };
    const auto ratio = static_cast<double>(exact_shift(s) / (centre_ * p_of(s)));
    return (term(s.u, cos_alpha_) + term(s.v, sin_alpha_)) * ratio;
  }

  // Some dozen roundings, of half an epsilon each, and 5e-17 of the series.
  void expect_right(const Shafts& s) const {
    const auto expected = static_cast<double>(exact_shift(s) * tan_alpha_);
    EXPECT_NEAR(backlash(s), expected, 6.0 * kEpsilon * tan_alpha_ * terms(s))
        << "A " << centre_ << ", u " << s.u << ", v " << s.v;
  }

  // The displacement in direction `angle` at which p has a given value: a root of
  // r^2/(2 A^2) + r d/A - p = 0 with d the direction's share along the line of centres.
  Shafts shafts_at(double p, double angle) const {
    const double d = cos_alpha_ * std::cos(angle) + sin_alpha_ * std::sin(angle);
    const double r = centre_ * 2.0 * p / (d + std::copysign(std::sqrt(d * d + 2.0 * p), d));
    return {r * std::cos(angle), r * std::sin(angle)};
  }

  ModelSetting setting_;
  std::vector<double> coefs_;
  double centre_ = 0.0, cos_alpha_ = 0.0, sin_alpha_ = 0.0, tan_alpha_ = 0.0;
  std::unique_ptr<PreparedPoint> point_;
};

// From 1e-12 to 30 centre distances, every direction, centre distances from the smallest to the
// largest: single digits of S - A are never lost, and both forms have their share.
TEST_F(Backlash, IsRightForAnyCentreDistanceAndAnyDisplacement) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> logarithm(-12.0, 1.5), turn(-1.0, 1.0);
  std::size_t near = 0, far = 0;
  for (const double A : {10.0, 60.0, 2400.0, 1e9}) {
    set_centre(A);
    for (int trial = 0; trial < 20000; ++trial) {
      const double size = A * std::pow(10.0, logarithm(random));
      const double angle = std::numbers::pi * turn(random);
      const Shafts shafts{size * std::cos(angle), size * std::sin(angle)};
      ++(std::abs(p_of(shafts)) < kNear ? near : far);
      expect_right(shafts);
    }
  }
  EXPECT_GT(near, 20000U);
  EXPECT_GT(far, 5000U);
}

// The series is worst at the end of its range, and there both forms must agree: neighbours on
// either side of it, whose exact values are 1e-12 of p apart, differ by that and the rounding.
TEST_F(Backlash, HasNoJumpWhereItsFormsMeet) {
  for (const double A : {10.0, 2400.0}) {
    set_centre(A);
    for (const double edge : {kNear, -kNear}) {
      for (const double angle : {0.0, 0.35, 1.2, 3.0, -2.5}) {
        const Shafts inside = shafts_at(edge * (1.0 - 1e-12), angle);
        const Shafts outside = shafts_at(edge * (1.0 + 1e-12), angle);
        ASSERT_LT(std::abs(p_of(inside)), kNear);
        ASSERT_GT(std::abs(p_of(outside)), kNear);
        expect_right(inside);
        expect_right(outside);
        const auto step = static_cast<double>(exact_shift(outside) - exact_shift(inside));
        EXPECT_NEAR(backlash(outside) - backlash(inside), step * tan_alpha_,
                    12.0 * kEpsilon * tan_alpha_ * terms(outside));
      }
    }
  }
}

// The gear's shaft on the pinion's: S = 0, b' = b - A tan(alpha). The root is taken of a sum of
// squares, so that no rounding makes it one of a negative number.
TEST_F(Backlash, IsANumberWhereTheShaftsCoincide) {
  for (const double A : {10.0, 60.0, 2400.0}) {
    set_centre(A);
    const double value = backlash({-A * cos_alpha_, -A * sin_alpha_});
    EXPECT_NEAR(value, -A * tan_alpha_, 6.0 * kEpsilon * A * tan_alpha_) << "A " << A;
  }
}

// On either flank df/du = -+ tan(alpha) (u + A cos(alpha))/S, likewise v, which D knows as well:
// dD/dv = -1 when v is x3. The Jacobian gives them times the mesh stiffness. A dozen roundings of
// numbers below 2: 1e-14.
TEST_F(Backlash, JacobianHasItsDerivative) {
  const std::size_t states = gear5().states.size();
  const std::size_t row = state_index(gear5(), "v1") * states;
  std::vector<double> jacobian(states * states);
  for (const double A : {10.0, 2400.0}) {
    set_centre(A);
    for (const double p : {-0.2, -2.0 * kNear, -0.9 * kNear, -1e-6, 1e-6, 0.9 * kNear, 0.3}) {
      const Shafts s = shafts_at(p, 0.8);
      const double S = std::hypot(A * cos_alpha_ + s.u, A * sin_alpha_ + s.v);
      for (const double flank : {1.0, -1.0}) {
        const std::vector<double> x = state_of(s, flank * 1e4);
        point_->jacobian(coefs_.data(), x.data(), jacobian.data());
        const double stiffness = jacobian[row + state_index(gear5(), "x1")];
        ASSERT_NE(stiffness, 0.0);
        const double by_u = jacobian[row + state_index(gear5(), "x4")] / stiffness;
        const double by_v = jacobian[row + state_index(gear5(), "x3")] / stiffness;
        EXPECT_NEAR(by_u, -flank * tan_alpha_ * (A * cos_alpha_ + s.u) / S, 1e-14);
        EXPECT_NEAR(by_v, -1.0 - flank * tan_alpha_ * (A * sin_alpha_ + s.v) / S, 1e-14);
      }
    }
  }
}

// The same derivative from the values that the right-hand side works with: central differences of
// fourth order over h = A/1000, whose error is of the order (h/A)^4 = 1e-12 times the fifth
// derivative of S A^4 (below 100 where S > A/2) over 30; rounding adds 1e-16 A/h.
TEST_F(Backlash, DerivativeIsThatOfItsValues) {
  for (const double A : {10.0, 2400.0}) {
    set_centre(A);
    for (const double p : {-0.2, -2.0 * kNear, -kNear, -1e-6, 1e-6, kNear, 0.3}) {
      const Shafts s = shafts_at(p, 0.8);
      const double S = std::hypot(A * cos_alpha_ + s.u, A * sin_alpha_ + s.v);
      const double h = A / 1000.0;
      const auto difference = [&](double du, double dv) {
        const auto at = [&](double k) { return backlash({s.u + k * du, s.v + k * dv}); };
        return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
      };
      EXPECT_NEAR(difference(h, 0.0), tan_alpha_ * (A * cos_alpha_ + s.u) / S, 1e-11);
      EXPECT_NEAR(difference(0.0, h), tan_alpha_ * (A * sin_alpha_ + s.v) / S, 1e-11);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
