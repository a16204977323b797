// Whether returns converge to an orbit: what is seen, and that offset, units and mirror images do
// not matter.
#include "tile/detail/orbit_convergence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "support/eigenvalues.hpp"

namespace gearsweep::testing {
namespace {

using Verdict = OrbitConvergence::Verdict;
using Map = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

constexpr double kSame = 1e-6;

std::vector<double> numbers_of(const Eigen::MatrixXd& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

TargetOrbit orbit_at(const Eigen::VectorXd& state, const Eigen::MatrixXd& derivative,
                     const Eigen::VectorXd& ranges, std::vector<std::size_t> angles = {}) {
  // Where units lie far apart, rounding would leave no digit of it.
  const Eigen::MatrixXd relative =
      ranges.cwiseInverse().asDiagonal() * derivative * ranges.asDiagonal();
  const double multiplier = eigenvalues_of(relative).cwiseAbs().maxCoeff();
  return {numbers_of(state),  numbers_of(derivative), multiplier,
          numbers_of(ranges), std::move(angles),      kSame};
}

// The verdict on at most so many returns of a map, from a state on.
Verdict verdict_on(const TargetOrbit& orbit, const Map& map, Eigen::VectorXd state,
                   std::size_t returns = 200) {
  OrbitConvergence view(orbit);
  Verdict verdict = view.add(numbers_of(state));
  for (std::size_t i = 0; i < returns && verdict == Verdict::open; ++i) {
    state = map(state);
    verdict = view.add(numbers_of(state));
  }
  return verdict;
}

struct Example {
  Eigen::MatrixXd derivative;  // largest multiplier below 0.97
  Eigen::VectorXd orbit, start;
};

// Any derivative, an orbit far from 0, and a start at up to a tenth of the range from it.
Example any_example(std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto any = [&] { return uniform(*random); };
  Example example;
  example.derivative = Eigen::MatrixXd::NullaryExpr(4, 4, any);
  const double largest = eigenvalues_of(example.derivative).cwiseAbs().maxCoeff();
  example.derivative *= (0.5 + 0.46 * std::abs(any())) / largest;
  example.orbit = 100.0 * Eigen::VectorXd::NullaryExpr(4, any);
  example.start = example.orbit + 0.1 * Eigen::VectorXd::NullaryExpr(4, any);
  return example;
}

const Eigen::VectorXd kOnes = Eigen::VectorXd::Ones(4);

TEST(OrbitConvergence, IsSeenOfEveryAffineMapThatContracts) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Example one = any_example(&random);
    const Map map = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(one.orbit + one.derivative * (x - one.orbit));
    };
    EXPECT_EQ(verdict_on(orbit_at(one.orbit, one.derivative, kOnes), map, one.start),
              Verdict::converges);
  }
}

// What goes round the orbit at a constant distance is not on its way there, however near: here a
// rotation, where the orbit's own derivative would contract.
TEST(OrbitConvergence, IsNotSeenOfMotionOnATorus) {
  const double angle = 2.0 * std::numbers::pi / std::numbers::phi;
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (const double radius : {1e-1, 1e-3, 1e-5}) {
    EXPECT_EQ(verdict_on(
                  orbit_at(Eigen::Vector2d(3.0, 4.0), 0.9 * turn, Eigen::Vector2d::Ones()),
                  [&](const Eigen::VectorXd& x) {
                    return Eigen::VectorXd(Eigen::Vector2d(3.0, 4.0) +
                                           turn * (x - Eigen::Vector2d(3.0, 4.0)));
                  },
                  Eigen::Vector2d(3.0 + radius, 4.0)),
              Verdict::leaves);
  }
}

// x -> 0.5 x + 20 x^2 has a fixed point at 0, whose basin ends at 1/40.
TEST(OrbitConvergence, EndsWithTheBasin) {
  const Map map = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(0.5 * x + 20.0 * x.cwiseProduct(x));
  };
  const auto verdict = [&](double start) {
    return verdict_on(orbit_at(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 0.5),
                               Eigen::VectorXd::Ones(1)),
                      map, Eigen::VectorXd::Constant(1, start));
  };
  EXPECT_EQ(verdict(0.01), Verdict::converges);
  EXPECT_EQ(verdict(-0.01), Verdict::converges);
  EXPECT_EQ(verdict(0.02), Verdict::converges);
  EXPECT_EQ(verdict(0.0251), Verdict::leaves);
}

// Next to a flip or a Neimark-Sacker bifurcation a trajectory alternates or goes round, and terms
// of second order take turns. They are hundreds of times what one return contracts here, and yet
// the distance halves when the derivative says so.
TEST(OrbitConvergence, IsSeenWhereTermsOfSecondOrderTakeTurns) {
  const Map flip = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(-0.98 * x + 5.0 * x.cwiseProduct(x));
  };
  EXPECT_EQ(verdict_on(orbit_at(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, -0.98),
                                Eigen::VectorXd::Ones(1)),
                       flip, Eigen::VectorXd::Constant(1, 0.02), 80),
            Verdict::converges);

  Eigen::Matrix2d turn;
  turn << std::cos(1.0), -std::sin(1.0), std::sin(1.0), std::cos(1.0);
  const Map round = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(0.98 * turn * x + 2.0 * Eigen::Vector2d(x[0] * x[1], x[0] * x[0]));
  };
  EXPECT_EQ(verdict_on(orbit_at(Eigen::Vector2d::Zero(), 0.98 * turn, Eigen::Vector2d::Ones()),
                       round, Eigen::Vector2d(0.02, 0.0), 80),
            Verdict::converges);
}

// Next to a fold nothing takes turns: x -> 0.98 x + x^2 goes to 0 from below 0.02 alone, and from
// just there only after a long time.
TEST(OrbitConvergence, WaitsNextToAFold) {
  const TargetOrbit orbit = orbit_at(
      Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 0.98), Eigen::VectorXd::Ones(1));
  const Map fold = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(0.98 * x + x.cwiseProduct(x));
  };
  const auto verdict = [&](double start) {
    return verdict_on(orbit, fold, Eigen::VectorXd::Constant(1, start), 80);
  };
  EXPECT_EQ(verdict(0.001), Verdict::converges);
  EXPECT_EQ(verdict(-0.001), Verdict::converges);
  EXPECT_EQ(verdict(0.0199), Verdict::open);
  EXPECT_EQ(verdict(0.0201), Verdict::open);
}

// What passes an orbit, from a stable direction of a saddle to an unstable one, is for some returns
// nearly where the orbit's derivative would have taken it. Here that would shrink all by 0.93 in
// each return, which halves in 10; the trajectory comes in by 0.91 and goes out by 1.02.
TEST(OrbitConvergence, IsNotSeenOfWhatPassesBy) {
  const Eigen::Matrix2d derivative = Eigen::Vector2d(-0.93, -0.93).asDiagonal();
  const Eigen::Matrix2d saddle = Eigen::Vector2d(-0.91, -1.02).asDiagonal();
  const Map map = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(saddle * x); };
  for (const double out : {0.05, 0.07, 0.09}) {
    EXPECT_EQ(verdict_on(orbit_at(Eigen::Vector2d::Zero(), derivative, Eigen::Vector2d::Ones()),
                         map, Eigen::Vector2d(0.05, 0.05 * out), 80),
              Verdict::leaves)
        << out;
  }
}

// A trajectory that is there already stays within rounding, and that does not contract.
TEST(OrbitConvergence, IsSeenOfWhatHasArrived) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-0.1 * kSame, 0.1 * kSame);
  const Example one = any_example(&random);
  EXPECT_EQ(verdict_on(
                orbit_at(one.orbit, one.derivative, kOnes),
                [&](const Eigen::VectorXd&) {
                  return Eigen::VectorXd(
                      one.orbit + Eigen::VectorXd::NullaryExpr(4, [&] { return noise(random); }));
                },
                one.orbit),
            Verdict::converges);
}

// A map with a term of second order, in units of its own for each state, moved elsewhere and in a
// mirror: the same verdict after the same number of returns. Powers of two keep all digits.
TEST(OrbitConvergence, DoesNotDependOnUnitsOffsetAndMirror) {
  std::mt19937 random(3);
  const Eigen::Vector4d units(-0x1p-20, 0x1p-3, 0x1p10, -0x1p30);
  std::size_t converging = 0;
  for (int i = 0; i < 100; ++i) {
    const Example one = any_example(&random);
    const Eigen::VectorXd start = one.start - one.orbit;
    const Map map = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(one.derivative * x + x.cwiseProduct(x.reverse()));
    };
    const Map scaled = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(units.cwiseProduct(map(x.cwiseQuotient(units))));
    };
    const Eigen::MatrixXd derivative =
        units.asDiagonal() * one.derivative * units.cwiseInverse().asDiagonal();
    for (std::size_t returns = 3; returns < 40; returns += 4) {
      const Verdict plain = verdict_on(orbit_at(Eigen::VectorXd::Zero(4), one.derivative, kOnes),
                                       map, start, returns);
      EXPECT_EQ(verdict_on(orbit_at(Eigen::VectorXd::Zero(4), derivative, units.cwiseAbs()), scaled,
                           units.cwiseProduct(start), returns),
                plain);
      if (plain == Verdict::converges) ++converging;
    }
  }
  EXPECT_GT(converging, 100U);
}

TEST(OrbitConvergence, TakesFullTurnsOutOfAngles) {
  const double turn = 2.0 * std::numbers::pi;
  double turns = 0.0;
  EXPECT_EQ(verdict_on(
                orbit_at(Eigen::VectorXd::Constant(1, 3.1), Eigen::MatrixXd::Constant(1, 1, 0.5),
                         Eigen::VectorXd::Ones(1), {0}),
                [&](const Eigen::VectorXd& x) {
                  const double old = x[0] - turn * turns;
                  turns -= 1.0;
                  return Eigen::VectorXd::Constant(1, 3.1 + 0.5 * (old - 3.1) + turn * turns);
                },
                Eigen::VectorXd::Constant(1, 3.2)),
            Verdict::converges);
}

}  // namespace
}  // namespace gearsweep::testing
