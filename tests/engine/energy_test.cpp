// Energy of gear5: what is conserved, and what the power balance of a steady motion is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "engine/outside_gear5.hpp"
#include "plan/plan.hpp"
#include "reference/detail/trajectory.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kMass = 0.3507525;  // m1 = m2
constexpr double kBearing = 1.38;    // k1..k4

// Energy of the undamped, unforced, frictionless system with mesh stiffness 1.
double energy(const std::vector<double>& x, double b) {
  const double D = x[0] - x[2] + x[4];
  const double f = D - std::clamp(D, -b, b);
  double kinetic = x[5] * x[5];
  double bearings = 0.0;
  for (std::size_t i = 1; i < 5; ++i) {
    kinetic += x[i + 5] * x[i + 5] / kMass;
    bearings += kBearing * x[i] * x[i];
  }
  return (kinetic + bearings + f * f) / 2.0;
}

// Largest relative change of the energy in `periods` periods, in the kernel. There is no loss and
// no input; `b` decides whether there are impacts: with b = 0 the teeth never part.
double energy_drift(const std::string& formulation, double b, std::size_t steps,
                    std::size_t periods) {
  const std::vector<double> start = {b + 0.3, 0.1, -0.1, 0.2, 0.15, 0.4, 0.1, -0.05, -0.1, 0.1};
  std::string state;
  for (std::size_t i = 0; i < 10; ++i) {
    state += (i > 0 ? ", " : "") + gear5().states[i].name + " = " + digits(start[i]);
  }
  const SweepResult result =
      run("[model]\nstiffness = 'fourier'\nformulation = '" + formulation +
          "'\n[parameters]\nkappa = 0.0\nzeta = 0.0\nmu = 0.0\nF1 = 0.0\ne0 = 0.0\n[[axes]]\n"
          "name = 'b'\nvalues = [" +
          digits(b) + "]\n[initial]\npolicy = 'fixed'\nstate = {" + state +
          "}\n[integrate]\nsettle = 0\nrecord = " + std::to_string(periods) +
          "\nsteps_per_period = " + std::to_string(steps) + "\n" + kObserveGear5);
  EXPECT_EQ(map_of(result, "contact_class")[0], 2.0);  // both flanks are met
  double drift = 0.0;
  for (std::size_t period = 0; period < periods; ++period) {
    std::vector<double> x(10);
    for (std::size_t i = 0; i < 10; ++i) x[i] = samples_of(result, 0, i)[period];
    drift = std::max(drift, std::abs(energy(x, b) / energy(start, b) - 1.0));
  }
  return drift;
}

// Without impacts the kernel's loss is that of the classical method on an oscillator, of fifth
// order in the step; halving the step must divide it by 16 at the very least.
TEST(Energy, IsConservedToTheIntegratorsOrder) {
  const double coarse = energy_drift("consistent", 0.0, 128, 20);
  const double middle = energy_drift("consistent", 0.0, 256, 20);
  const double fine = energy_drift("consistent", 0.0, 512, 20);
  EXPECT_GT(coarse, 1e-9);  // above rounding, so that the ratios mean something
  EXPECT_LT(middle, coarse / 16.0);
  EXPECT_LT(fine, middle / 16.0);
}

// Some 60 steps cross an edge of the backlash; corrected, each adds an error of fourth order in its
// length, of either sign. Four times the steps divide their sum by 256, give or take a few for
// where in their steps the edges lie.
TEST(Energy, IsConservedThroughImpacts) {
  const double coarse = energy_drift("consistent", 1.0, 128, 20);
  const double fine = energy_drift("consistent", 1.0, 512, 20);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, coarse / 64.0);
}

// The printed sign of the shafts in the deflection gives their motion negative energy.
TEST(Energy, IsNotConservedAsPrinted) { EXPECT_GT(energy_drift("printed", 0.05, 8192, 3), 1.0); }

// The works over a steady period, each in its own sum, by the trapezoidal rule on the trajectory.
struct Works {
  double input = 0.0, bearings = 0.0, mesh = 0.0, friction = 0.0, parametric = 0.0, backlash = 0.0;
  double wedged = 0.0;  // share of the time in which both flanks are compressed
  double balance() const { return input - bearings - mesh + friction + parametric - backlash; }
};

Works works_of(const std::string& toml) {
  const Study study = read_study(toml, "test.toml");
  const Plan plan(study, 1);
  const ModelSetting setting = plan.setting_of(0);
  const OutsideGear gear(setting);
  // Longer steps lead to within 1e-7 of the motion; damping takes away what is left of that, as it
  // takes away a fifth or more of any distance in each period.
  const Plan quick(read_study(toml, "test.toml", {"integrate.steps_per_period=512"}), 1);
  const std::vector<double> start = plan.own_initial_state(0);
  Trajectory near(quick, 0, Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index{10}));
  for (int period = 0; period < 200; ++period) near.advance_period();
  Trajectory trajectory(plan, 0, near.state());
  for (int period = 0; period < 40; ++period) trajectory.advance_period();

  const std::size_t of_backlash = signal_index(gear5(), "backlash");
  const double zeta = parameter_of(setting, "zeta");
  const double c = parameter_of(setting, "c1");
  const double omega = parameter_of(setting, "omega");
  const double amplitude = parameter_of(setting, "e0") * omega * omega;
  // `squares` and `sizes` are sums over the flanks: of a wedged tooth both are compressed.
  struct Powers {
    double input, bearings, mesh, friction, squares, sizes;
  };
  const auto powers = [&](const Instant& moment, double psi, const MeshSums& s) {
    const Eigen::VectorXd& x = moment.state;
    const double D = moment.signals[signal_index(gear5(), "deflection")];
    const double drive = std::max(D - moment.signals[of_backlash], 0.0);
    const double back = std::min(D + moment.signals[of_backlash], 0.0);
    const double f = drive + back;
    const double rate = x[5] - x[7] + x[9];
    const double across = x[8] - x[6];
    Powers p{};
    p.input =
        (parameter_of(setting, "F1") + amplitude * std::sin(2.0 * std::numbers::pi * psi)) * x[5];
    p.bearings = 2.0 * c * zeta * x.tail(4).squaredNorm();
    p.mesh = 4.0 * zeta * rate * rate;
    p.friction = (s.B - s.Q) * f * x[5] + s.C * f * across +
                 2.0 * zeta * ((2.0 - s.G) * rate * x[5] + s.H * rate * across);
    p.squares = drive * drive + back * back;
    p.sizes = drive - back;
    return p;
  };
  Works sum;
  double psi = 0.0;
  double stiffness_before = gear.sums(1.0, 1.0 - 1e-9).B;  // what the last period ended with
  trajectory.advance_period([&](const TrajectoryStep& step) {
    const Instant& before = step.before;
    const Instant& after = step.after;
    const double share = step.share;
    const double inside = psi + 0.5 * share;
    const MeshSums s0 = gear.sums(psi, inside);
    const MeshSums s1 = gear.sums(psi + share, inside);
    const Powers p0 = powers(before, psi, s0);
    const Powers p1 = powers(after, psi + share, s1);
    const double half = 0.5 * share * gear.period();
    sum.input += half * (p0.input + p1.input);
    sum.bearings += half * (p0.bearings + p1.bearings);
    sum.mesh += half * (p0.mesh + p1.mesh);
    sum.friction += half * (p0.friction + p1.friction);
    // The stiffness' change works on the compressed teeth, by jumps at the break phases too.
    sum.parametric += 0.5 * p0.squares * (s0.B - stiffness_before) +
                      0.25 * (p0.squares + p1.squares) * (s1.B - s0.B);
    stiffness_before = s1.B;
    sum.backlash += 0.5 * (s0.B * p0.sizes + s1.B * p1.sizes) *
                    (after.signals[of_backlash] - before.signals[of_backlash]);
    sum.wedged += p0.squares != p0.sizes * p0.sizes ? share : 0.0;
    psi += share;
  });
  return sum;
}

// Two tests ask for the same motions.
const Works& works_once(const std::string& toml) {
  static std::map<std::string, Works> known;
  const auto found = known.find(toml);
  return found != known.end() ? found->second : known.emplace(toml, works_of(toml)).first->second;
}

// Steady motions: what goes in goes out. The trapezoidal rule errs by (9/8192)^2/12 = 1e-7 of the
// change of a power's slope, some 0.1; the motion repeats to 1e-9.
void expect_balance(const Works& works, double tolerance = 1e-8) {
  EXPECT_NEAR(works.balance(), 0.0, tolerance);
  EXPECT_GT(works.bearings, 1e-3);
  EXPECT_GT(works.mesh, 1e-3);
  EXPECT_GT(std::abs(works.friction), 1e-5);
  EXPECT_GT(std::abs(works.parametric), 1e-5);
}

const std::string kBalanced =
    "mu = 0.1\n[[axes]]\nname = 'omega'\nvalues = [0.65]\n[integrate]\nsteps_per_period = 8192\n";

std::string balanced(const std::string& law) {
  return "[model]\npreset = 'coarse'\nbacklash = '" + law + "'\n[parameters]\n" + kBalanced;
}

TEST(Energy, PowerBalance) {
  const Works& works = works_once(balanced("constant"));
  expect_balance(works);
  EXPECT_EQ(works.backlash, 0.0);
}

// The signals are the powers of the balance: their means are the works of a period over its length,
// of a motion that has settled.
TEST(Energy, MeanPowersAreThoseOfTheBalance) {
  for (const char* const law : {"constant", "dynamic"}) {
    const Works& works = works_once(balanced(law));
    const SweepResult result = run(balanced(law) +
                                   "settle = 200\nrecord = 1\nstop = 'never'\n[observe]\n"
                                   "quantities = ['power_damping_mean', 'power_friction_mean']\n");
    const double period = 2.0 * std::numbers::pi / 0.65;
    const double damping = map_of(result, "power_damping_mean")[0] * period;
    const double friction = map_of(result, "power_friction_mean")[0] * period;
    EXPECT_NEAR(damping, works.bearings + works.mesh, 1e-8) << law;
    EXPECT_NEAR(friction, -works.friction, 1e-8) << law;
    // What goes in is taken by these, but for what the stiffness and the backlash do.
    EXPECT_NEAR(works.input + works.parametric - works.backlash, damping + friction, 1e-8) << law;
  }
}

TEST(Energy, PowerBalanceWithDynamicBacklash) {
  const Works& works = works_once(balanced("dynamic"));
  expect_balance(works);
  EXPECT_GT(std::abs(works.backlash), 1e-3);
}

// The period is 12.5 and the forces are ten times those of the others: 2e-7 of a change of slope of
// some 1 at each of a dozen crossings, which partly cancel.
TEST(Energy, PowerBalanceOfAWedgedTooth) {
  const Works works = works_of(
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nb = 0.2553\n[[axes]]\n"
      "name = 'omega'\nvalues = [0.5021]\n[integrate]\nsteps_per_period = 8192\n");
  expect_balance(works, 5e-7);
  EXPECT_GT(works.wedged, 5e-3);
}

TEST(Energy, PowerBalanceWithRectangularStiffness) {
  expect_balance(works_of(
      "[model]\npreset = 'consistent'\nstiffness = 'rectangular'\n[parameters]\n" + kBalanced));
}

}  // namespace
}  // namespace gearsweep::testing
