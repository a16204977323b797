// Cycles and equilibria of models that nothing drives, against closed forms and SciPy.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>

#include "model/error.hpp"
#include "orbits/example_orbits.hpp"
#include "orbits/orbit_error.hpp"
#include "study/model_file.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// theta only rises, and jumps back where the next spoke lands: it has no maximum. Each step a spoke
// loses all but cos(2 alpha)^2 of its energy, 2 sin(alpha) sin(slope) more than it gets back at
// the next one (McGeer 1990).
TEST(Cycles, ReturnToTheSectionOfTheirModel) {
  const double alpha = 0.4, slope = 0.08;
  const Example wheel("rimless_wheel", {{"alpha", alpha}, {"slope", slope}});
  const PeriodMap map = wheel.map();
  const Eigen::VectorXd settled =
      map.advance(Eigen::Vector2d(slope - alpha, 0.5), TimeSpan{200.0, 10000}).value();
  const Orbit cycle = find_cycle(map, settled, {0.02, kSteps, {}});
  EXPECT_EQ(cycle.period, 1U);
  const double kept = std::pow(std::cos(2.0 * alpha), 2);
  EXPECT_NEAR(cycle.multipliers[0].real(), kept, 1e-10);
  const double landing = 4.0 * std::sin(alpha) * std::sin(slope) * kept / (1.0 - kept);
  const double energy = 0.5 * std::pow(cycle.state[1], 2) + std::cos(cycle.state[0]);
  EXPECT_NEAR(energy, 0.5 * landing + std::cos(slope - alpha), 1e-11);
}

// The wheel's multiplier is the same at any slope, up to the slope at which it stops over its foot.
TEST(Cycles, HaveNoBifurcationWhereTheirMultipliersAreRounding) {
  const Example wheel("rimless_wheel", {{"slope", 0.074}});
  const PeriodMap map = wheel.map();
  const Eigen::VectorXd settled =
      map.advance(Eigen::Vector2d(-0.3, 0.45), TimeSpan{200.0, 10000}).value();
  const Branch branch =
      wheel.follow(find_cycle(map, settled, {0.02, 256, {}}), "slope", 0.07, 0.075, false, 256);
  EXPECT_TRUE(branch.bifurcations.empty());
  const double stops = branch.orbits.back().parameter;
  EXPECT_NEAR(stops, 0.0724388, 1e-6);
}

// Small cycles about the rest, where no tooth parts, are all at the parameter of the Hopf
// bifurcation: 0.065482361894 by the eigenvalues.
TEST(Cycles, OfAFamilyAtOneParameterDoNotTurn) {
  const Example gear("gear_squeal", {{"mu", 0.07}});
  const PeriodMap map = gear.map();
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(6, 0.1);
  const Eigen::VectorXd settled = map.advance(start, TimeSpan{4000.0, 80000}).value();
  const Branch branch =
      gear.follow(find_cycle(map, settled, {0.05, 512, {}}), "mu", 0.06, 0.08, false, 512);
  EXPECT_TRUE(branch.bifurcations.empty());
  EXPECT_NEAR(branch.orbits.back().parameter, 0.065482361894, 1e-9);
}

// The cycle that a motion from states of 1 comes to in `time`.
Orbit cycle_of(const Example& example, double time, std::optional<std::size_t> period = {}) {
  const double step = 0.02;
  const PeriodMap map = example.map(2048);
  const auto states = static_cast<Eigen::Index>(example.model->states.size());
  const Eigen::VectorXd settled = map.advance(Eigen::VectorXd::Ones(states),
                                              TimeSpan{time, static_cast<std::size_t>(time / step)})
                                      .value();
  return find_cycle(map, settled, {step, 2048, period});
}

Orbit rest_of(const Example& example, const std::vector<double>& near) {
  return find_equilibrium(example.map(), Eigen::Map<const Eigen::VectorXd>(
                                             near.data(), static_cast<Eigen::Index>(near.size())))
      .value();
}

// Shooting with DOP853 at 1e-13.
TEST(Cycles, OfRoesslersFlowHaveTheirTimeAndMultipliers) {
  const Orbit cycle = cycle_of(Example("rossler", {{"c", 2.5}}), 500.0);
  EXPECT_EQ(cycle.kind, OrbitKind::cycle);
  EXPECT_EQ(cycle.period, 1U);
  EXPECT_NEAR(cycle.duration, 5.748991183278, 1e-10);
  ASSERT_EQ(cycle.multipliers.size(), 2);
  EXPECT_NEAR(cycle.multipliers[0].real(), -0.769693642, 1e-9);
  EXPECT_NEAR(cycle.multipliers[1].real(), -5.17430e-6, 1e-10);
  EXPECT_NEAR(cycle.along.value(), 1.0, 1e-8);
  EXPECT_NEAR(cycle_of(Example("rossler", {{"c", 3.5}}), 500.0).duration, 11.545218288, 1e-8);
  const Orbit four = cycle_of(Example("rossler", {{"c", 4.0}}), 2000.0);
  EXPECT_EQ(four.period, 4U);
  EXPECT_NEAR(four.duration, 23.177001056, 1e-7);
}

TEST(Cycles, AreFoundInsideChaos) {
  const Example chaos("rossler", {{"c", 5.7}});
  EXPECT_THROW(cycle_of(chaos, 200.0), RunError);
  const Orbit inside = cycle_of(chaos, 200.0, 1);
  EXPECT_EQ(inside.unstable_count(), 1U);
  // P. Cvitanovic et al., Chaos: Classical and Quantum, the shortest cycle of this flow.
  EXPECT_NEAR(inside.duration, 5.88108845586, 1e-7);
  EXPECT_NEAR(inside.multipliers[0].real(), -2.40395353, 1e-6);
}

// The shortest cycle inside Lorenz's attractor (D. Viswanath, Nonlinearity 16 (2003) 1035-1056).
TEST(Cycles, InsideLorenzAttractorAreThePublishedOnes) {
  const Example example("lorenz", {{"rho", 28.0}});
  const Eigen::Vector3d near(-13.763610682134, -19.578751942452, 27.0);
  const Orbit cycle = find_cycle(example.map(2048), near, {0.005, 2048, 1});
  EXPECT_NEAR(cycle.duration, 1.5586522107162, 1e-8);
  EXPECT_EQ(cycle.unstable_count(), 1U);
}

TEST(Cycles, DoubleWhereAMultiplierIsMinusOne) {
  const Example example("rossler", {{"c", 2.7}});
  const Branch branch = example.follow(cycle_of(example, 500.0), "c", 2.4, 3.4, true);
  ASSERT_EQ(branch.bifurcations.size(), 1U);
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::flip);
  // By DOP853 at 1e-13, and Brent's method.
  EXPECT_NEAR(branch.bifurcations[0].parameter, 2.83244502786, 1e-8);
  // The doubled cycle begins there.
  const Example doubled("rossler", {{"c", 3.2}});
  const Branch back = doubled.follow(cycle_of(doubled, 500.0), "c", 2.6, 3.6, false);
  ASSERT_EQ(back.bifurcations.size(), 1U);
  EXPECT_EQ(back.bifurcations[0].kind, Bifurcation::flip);
  EXPECT_EQ(back.bifurcations[0].born_of, 1U);
  EXPECT_NEAR(back.bifurcations[0].parameter, 2.83244502786, 1e-6);
  // In steps of a wide range the doubled cycle and the single one are near each other there.
  const Example far("rossler", {{"c", 3.5}});
  const Branch wide = far.follow(cycle_of(far, 500.0), "c", 2.6, 6.0, false);
  ASSERT_EQ(wide.bifurcations.size(), 1U);
  EXPECT_NEAR(wide.bifurcations[0].parameter, 2.83244502786, 1e-6);
}

// The eigenvalues of the Brusselator's rest at (a, b/a) have the real part (b - 1 - a^2)/2. Over a
// cycle the divergence is -1.157973 in the mean, by DOP853.
TEST(Cycles, AreBornAtHopfBifurcations) {
  const Example example("brusselator", {{"b", 2.5}});
  const Orbit cycle = cycle_of(example, 200.0);
  const Branch branch = example.follow(cycle, "b", 1.5, 3.0, false);
  ASSERT_EQ(branch.bifurcations.size(), 1U);
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::hopf);
  EXPECT_NEAR(branch.bifurcations[0].parameter, 2.0, 1e-9);
  EXPECT_LE(std::fabs(branch.bifurcations[0].parameter - 2.0), branch.bifurcations[0].error);
  EXPECT_THAT(branch.ended, HasSubstr("shrinks to an equilibrium"));
  const Orbit wide = cycle_of(Example("brusselator", {{"b", 3.0}}), 200.0);
  EXPECT_NEAR(wide.duration, 7.156919921, 1e-7);
  EXPECT_NEAR(std::log(wide.multipliers[0].real()) / wide.duration, -1.157973, 1e-4);
}

constexpr const char* kRotor = R"toml([model]
name = "rotor"
[states]
q = { angle = true }
w = { start = 5.0 }
[parameters]
torque = 1.5
friction = 0.3
[equations]
q = "w"
w = "torque - friction*w - sin(q)"
)toml";

// A pendulum that goes over: divergence is that of friction, so its multiplier is exp(-friction T),
// and over a turn friction takes what the torque gives: the integral of w^2 is torque 2
// pi/friction.
TEST(Cycles, MayGoRoundAnAngle) {
  const auto model = read_model_text(kRotor, "rotor.toml");
  const ModelSetting setting = model->default_setting();
  const PeriodMap map(*model, setting, 2048);
  EXPECT_FALSE(map.driven());
  const Eigen::VectorXd settled =
      map.advance(Eigen::Vector2d(0.0, 5.0), TimeSpan{100.0, 10000}).value();
  const Orbit cycle = find_cycle(map, settled, {0.01, 2048, {}});
  EXPECT_NEAR(cycle.multipliers[0].real(), std::exp(-0.3 * cycle.duration), 1e-10);
  double work = 0.0;
  Eigen::VectorXd state = cycle.state;
  constexpr std::size_t kParts = 400;
  for (std::size_t i = 0; i < kParts; ++i) {
    work += state[1] * state[1] * cycle.duration / kParts;
    state = map.advance(state, TimeSpan{cycle.duration / kParts, 10}).value();
  }
  EXPECT_NEAR(work, 1.5 * 2.0 * std::numbers::pi / 0.3, 1e-8);
  EXPECT_NEAR(state[0] - cycle.state[0], 2.0 * std::numbers::pi, 1e-9);
  // Without enough torque it hangs, at asin(torque), and does so up to the torque 1.
  ModelSetting weak = setting;
  weak.parameters[0] = 0.7;
  const Orbit hangs =
      find_equilibrium(PeriodMap(*model, weak, 64), Eigen::Vector2d(0.5, 0.0)).value();
  EXPECT_NEAR(hangs.state[0], std::asin(0.7), 1e-13);
  const Branch branch = follow_orbit({model.get(), weak, 0, 0.1, 2.0, 64, true}, hangs);
  ASSERT_EQ(branch.bifurcations.size(), 1U);
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::fold);
  EXPECT_NEAR(branch.bifurcations[0].parameter, 1.0, 1e-9);
}

TEST(Equilibria, OfLorenzFlowChangeWhereTheyShould) {
  const Example example("lorenz", {{"rho", 22.0}});
  const Orbit rest = rest_of(example, {8.0, 8.0, 20.0});
  const double side = std::sqrt(8.0 / 3.0 * 21.0);
  EXPECT_EQ(rest.kind, OrbitKind::equilibrium);
  EXPECT_NEAR(rest.state[0], side, 1e-12);
  EXPECT_NEAR(rest.state[2], 21.0, 1e-12);
  EXPECT_TRUE(rest.stable());
  const Branch up = example.follow(rest, "rho", 0.5, 28.0, true);
  ASSERT_EQ(up.bifurcations.size(), 1U);
  EXPECT_EQ(up.bifurcations[0].kind, Bifurcation::hopf);
  EXPECT_NEAR(up.bifurcations[0].parameter, 470.0 / 19.0, 1e-8);
  // It comes out of the other rest, at 0, of which it is one of two.
  const Branch down = example.follow(rest, "rho", 0.5, 28.0, false);
  ASSERT_EQ(down.bifurcations.size(), 1U);
  EXPECT_EQ(down.bifurcations[0].kind, Bifurcation::branching);
  EXPECT_NEAR(down.bifurcations[0].parameter, 1.0, 1e-6);
  EXPECT_THAT(down.ended, HasSubstr("begins near"));
  const Orbit origin = rest_of(example, {0.1, 0.1, 0.2});
  EXPECT_EQ(origin.unstable_count(), 1U);
  // (-11 + sqrt(121 + 40 (rho - 1)))/2
  EXPECT_NEAR(origin.multipliers[0].real(), 10.0, 1e-9);
}

TEST(Equilibria, AreKnownToRounding) {
  const Example example("lorenz", {{"rho", 22.0}});
  const OrbitError error = error_of(rest_of(example, {8.0, 8.0, 20.0}), example.map());
  EXPECT_LT(error.state.maxCoeff(), 1e-9);
  EXPECT_LT(error.multipliers.maxCoeff(), 1e-9);
}

// A model of its equations, and a parameter `m` to follow along.
struct Written {
  std::shared_ptr<const Model> model;
  ModelSetting setting;

  Written(const std::string& states, const std::string& equations, double m)
      : model(read_model_text("[model]\nname = 'written'\n[states]\n" + states +
                                  "[parameters]\nm = 1.0\n[equations]\n" + equations,
                              "written.toml")),
        setting(model->default_setting()) {
    setting.parameters[0] = m;
  }
  PeriodMap map() const { return {*model, setting, 2048}; }
  Orbit cycle(const Eigen::VectorXd& start, double time, double step) const {
    const PeriodMap from = map();
    const auto steps = static_cast<std::size_t>(time / step);
    return find_cycle(from, from.advance(start, TimeSpan{time, steps}).value(), {step, 2048, {}});
  }
  Branch follow(const Orbit& start, double low, double high, bool upwards) const {
    return follow_orbit({model.get(), setting, 0, low, high, 2048, upwards}, start);
  }
};

// Three lags and a relay with hysteresis, whose output is a state that resets alone change. Any
// output has an equilibrium, which comes back after any time. T and multipliers by the matrix
// exponential of half a cycle and its jump (SciPy).
TEST(Cycles, OfARelayAreNoneOfItsEquilibria) {
  const Written relay("x = {}\ny = {}\nz = {}\nu = { start = 1 }\n",
                      "x = 'u - m*x'\ny = 'x - y'\nz = 'y - z'\nu = '0'\n"
                      "[surfaces.off]\nwhen = 'z - 0.1'\nreset = { u = '-1' }\n"
                      "[surfaces.on]\nwhen = '-z - 0.1'\nreset = { u = '1' }\n",
                      1.0);
  const Orbit cycle = relay.cycle(Eigen::Vector4d(0.0, 0.0, 0.0, 1.0), 200.0, 0.02);
  EXPECT_NEAR(cycle.duration, 4.7876719420454, 1e-9);
  EXPECT_NEAR(cycle.multipliers[0].real(), 2.5927482e-2, 1e-9);
  EXPECT_NEAR(cycle.multipliers[1].real(), 2.2308026e-5, 1e-9);
}

// A motion that is counted from up to eight thousand times its size away: rounding of y is that of
// x and z, too. Against SciPy's DOP853 with Newton's method; the rest is where 0.6 + m z = z^3/3.
TEST(Cycles, AreTheSameWhereverTheirStatesAreCountedFrom) {
  for (const double from : {0.0, -700.0, -7000.0}) {
    SCOPED_TRACE(from);
    const std::string y = fmt::format("(y - ({}))", from);
    const Written field(
        "x = { start = 0.1 }\ny = {}\nz = {}\n",
        fmt::format("x = '(z - 0.7)*x - 3.5*{0}'\ny = '3.5*x + (z - 0.7)*{0}'\n"
                    "z = '0.6 + m*z - z^3/3 - (x^2 + {0}^2)*(1 + 0.25*z) + 0.1*z*x^3'\n",
                    y),
        0.6);
    const Orbit cycle = field.cycle(Eigen::Vector3d(0.1, from, 0.5), 100.0, 0.01);
    EXPECT_NEAR(cycle.duration, 1.7951958022, 1e-9);
    EXPECT_NEAR(cycle.multipliers[0].real(), -0.69481089, 1e-7);
    EXPECT_NEAR(std::abs(cycle.multipliers[0].imag()), 0.61549694, 1e-7);
    const Orbit rest = find_equilibrium(field.map(), Eigen::Vector3d(0.1, from, 0.5)).value();
    EXPECT_NEAR(rest.state[2], 1.692240671, 1e-8);
  }
}

TEST(Equilibria, AreNotWhereNothingIsBalanced) {
  const Written drift("x = {}\ny = {}\n", "x = '1'\ny = '-m*y'\n", 1.0);
  EXPECT_FALSE(find_equilibrium(drift.map(), Eigen::Vector2d(0.5, 0.5)).has_value());
}

// A center has a family of cycles at any parameter: rounding of its real parts crosses nothing.
TEST(Equilibria, OfACenterHaveNoHopfBifurcation) {
  const Written prey("x = {}\ny = {}\n", "x = 'x*(1 - y)'\ny = 'm*y*(x - 1)'\n", 1.0);
  const Orbit rest = find_equilibrium(prey.map(), Eigen::Vector2d(0.9, 1.1)).value();
  for (const bool upwards : {false, true}) {
    EXPECT_TRUE(prey.follow(rest, 0.1, 4.0, upwards).bifurcations.empty());
  }
}

// c is conserved, and its eigenvalue is 0 throughout; the pair m +- i crosses at m = 0.
TEST(Equilibria, HaveHopfBifurcationsBesideWhatIsConserved) {
  const Written turning("x = {}\ny = {}\nc = { start = 0.5 }\n",
                        "x = 'm*x - c*y - x*(x^2 + y^2)'\ny = 'c*x + m*y - y*(x^2 + y^2)'\n"
                        "c = '0*m'\n",
                        -0.3);
  const Orbit rest = find_equilibrium(turning.map(), Eigen::Vector3d(0.1, 0.1, 0.5)).value();
  const Branch branch = turning.follow(rest, -0.5, 1.0, true);
  ASSERT_EQ(branch.bifurcations.size(), 1U) << branch.ended;
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::hopf);
  EXPECT_NEAR(branch.bifurcations[0].parameter, 0.0, 1e-9);
}

// In the plane no multiplier is negative: near its homoclinic end (m = -0.74344427, by DOP853) a
// cycle may be lost, but does not flip.
TEST(Cycles, EndAtAHomoclinicOrbitWithoutInventions) {
  const Written takens("x = {}\ny = {}\n", "x = 'y'\ny = '-1 + x^2 - x*y + m*y'\n", -0.9);
  const Orbit cycle = takens.cycle(Eigen::Vector2d(-1.0, 0.3), 400.0, 0.02);
  EXPECT_NEAR(cycle.duration, 5.006099758, 1e-8);
  const Branch up = takens.follow(cycle, -2.0, 3.0, true);
  EXPECT_TRUE(up.bifurcations.empty());
  EXPECT_NEAR(up.orbits.back().parameter, -0.74344427, 1e-3);
  const Branch down = takens.follow(cycle, -2.0, 3.0, false);
  ASSERT_EQ(down.bifurcations.size(), 1U);
  EXPECT_EQ(down.bifurcations[0].kind, Bifurcation::hopf);
  EXPECT_NEAR(down.bifurcations[0].parameter, -1.0, 1e-9);
}

// z does not move along the cycle r = 1, but along m; 0 and m change stability at m = 0.
TEST(Cycles, AreFollowedWhereAStateHardlyMoves) {
  const Written still("x = {}\ny = {}\nz = {}\n",
                      "x = 'x - y - x*(x^2 + y^2)'\ny = 'x + y - y*(x^2 + y^2)'\nz = 'm*z - z^2'\n",
                      0.5);
  const Orbit cycle = still.cycle(Eigen::Vector3d(1.0, 0.0, 0.3), 100.0, 0.05);
  EXPECT_NEAR(cycle.duration, 2.0 * std::numbers::pi, 1e-10);
  const Branch branch = still.follow(cycle, -0.9, 1.0, false);
  ASSERT_EQ(branch.bifurcations.size(), 1U) << branch.ended;
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::branching);
  EXPECT_NEAR(branch.bifurcations[0].parameter, 0.0, 1e-8);
  EXPECT_THAT(branch.ended, HasSubstr("reached"));
  // So they are where the range is so long that the cycle is small beside it.
  EXPECT_THAT(still.follow(cycle, 0.1, 1e6, true).ended, Not(HasSubstr("shrinks")));
}

// The Brusselator in nanoseconds, with lengths of 1000 and of a millionth.
TEST(Cycles, AreBornInAnyUnits) {
  const Written scaled("x = {}\ny = {}\n",
                       "x = '1e12*(1 - (m + 1)*x/1e3 + (x/1e3)^2*(y/1e-6))'\n"
                       "y = '1e3*(m*x/1e3 - (x/1e3)^2*y/1e-6)'\n",
                       2.5);
  const Orbit cycle = scaled.cycle(Eigen::Vector2d(1e3, 2e-6), 200e-9, 0.01e-9);
  EXPECT_NEAR(cycle.duration * 1e9, 6.577284342, 1e-6);
  const Branch branch = scaled.follow(cycle, 1.0, 4.0, false);
  ASSERT_EQ(branch.bifurcations.size(), 1U) << branch.ended;
  EXPECT_EQ(branch.bifurcations[0].kind, Bifurcation::hopf);
  EXPECT_NEAR(branch.bifurcations[0].parameter, 2.0, 1e-9);
}

}  // namespace
}  // namespace gearsweep::testing
