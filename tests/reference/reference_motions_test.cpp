// The reference engine's period, settling and kind of motion: on published motions, and beside the
// kernel's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reference/motion_classes.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::NanSensitiveDoubleEq;

const std::string kObserve =
    "[observe]\nquantities = ['period', 'settled', 'motion_class', 'zero_one']\n";

SweepResult run_reference(const std::string& study) {
  return run(study, {"integrate.engine='reference'"});
}

// The pendulum doubles its period at Q = 1.34921264 and 1.37012224, the Duffing oscillator at an
// amplitude of 0.26558179 and 0.28669316 (found by shooting); the points lie well between these.
TEST(ReferencePeriod, DoublesAsPublished) {
  const SweepResult pendulum = run_reference(
      "[model]\nname = 'pendulum'\npreset = 'cascade'\n[[axes]]\nname = 'damping'\n"
      "values = [0.7293, 0.7353, 0.7463]\n[initial]\nstate = {x = 0.1}\n"  // Q 1.371, 1.36, 1.34
      "[integrate]\nsettle = 600\nrecord = 120\nsteps_per_period = 128\n" +
      kObserve);
  EXPECT_EQ(map_of(pendulum, "period"), (std::vector<double>{4.0, 2.0, 1.0}));
  EXPECT_THAT(map_of(pendulum, "motion_class"), Each(kPeriodic));
  const SweepResult duffing = run_reference(
      "[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\ndamping = 0.3\nomega = 1.2\n"
      "[[axes]]\nname = 'amplitude'\nvalues = [0.25, 0.277, 0.289]\n[initial]\nstate = {x = 1.0}\n"
      "[integrate]\nsettle = 600\nrecord = 120\nsteps_per_period = 128\n" +
      kObserve);
  EXPECT_EQ(map_of(duffing, "period"), (std::vector<double>{1.0, 2.0, 4.0}));
  EXPECT_THAT(map_of(duffing, "motion_class"), Each(kPeriodic));
}

// Strange attractors with published exponents: 0.1034, 0.1572 and 0.1414 per unit of time,
// which is 300 and more over the record.
TEST(ReferenceMotion, IsChaoticWherePublishedExponentsArePositive) {
  const auto chaos = [](const std::string& model, const std::string& preset) {
    const SweepResult result =
        run_reference("[model]\nname = '" + model + "'\npreset = '" + preset +
                      "'\n[[axes]]\nname = 'x'\nvalues = [0.2, 0.3]\n"
                      "[integrate]\nsettle = 100\nrecord = 500\n"
                      "steps_per_period = 128\n" +
                      kObserve);
    EXPECT_THAT(map_of(result, "motion_class"), Each(kChaotic)) << model;
    EXPECT_THAT(map_of(result, "period"), Each(0.0)) << model;
    return map_of(result, "zero_one");
  };
  // Finite records leave a few hundredths.
  EXPECT_THAT(chaos("duffing", "ueda"), Each(DoubleNear(1.0, 0.1)));
  EXPECT_THAT(chaos("duffing", "two_well"), Each(DoubleNear(1.0, 0.1)));
  // The pendulum goes over the top this way and that; full turns are taken out of its angle.
  EXPECT_THAT(chaos("pendulum", "sprott"), Each(DoubleNear(1.0, 0.1)));
}

// Both engines on the same study; all maps but those of chaotic points must agree. These part from
// each other within the record, and have the same class. The reference engine has every state, and
// `settled` waits for each.
void expect_engines_agree(const std::string& study, const std::vector<double>& classes) {
  const SweepResult kernel = run(study + kObserve, {"integrate.states='all'"});
  const SweepResult reference = run_reference(study + kObserve);
  EXPECT_THAT(kernel.status, Each(0));
  EXPECT_THAT(reference.status, Each(0));
  EXPECT_EQ(map_of(kernel, "motion_class"), map_of(reference, "motion_class"));
  for (const double motion : classes) EXPECT_THAT(map_of(kernel, "motion_class"), Contains(motion));
  for (std::size_t i = 0; i < kernel.status.size(); ++i) {
    SCOPED_TRACE(kernel.study.axes[0].values[i]);
    EXPECT_EQ(map_of(kernel, "period")[i], map_of(reference, "period")[i]);
    if (map_of(kernel, "motion_class")[i] == kChaotic) continue;
    EXPECT_THAT(map_of(reference, "settled")[i],
                NanSensitiveDoubleEq(map_of(kernel, "settled")[i]));
    // Regular motions of the two engines stay within 1e-12 of each other. K is that of a series
    // that varies by 1e-6 or more, so that this is at most a millionth of it.
    EXPECT_NEAR(map_of(kernel, "zero_one")[i], map_of(reference, "zero_one")[i], 1e-6);
  }
}

// Periods 1 to 8, transients that last beyond the record, a torus.
TEST(ReferenceOrbits, AreThoseOfTheKernel) {
  expect_engines_agree(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\n"
      "values = [0.5, 0.58, 0.6, 0.62, 0.65, 0.7, 0.82, 0.84, 0.86, 0.88, 0.9, 0.92, 0.98, 1.0, "
      "1.02, 1.22, 1.44, 1.7, 1.86, 1.88, 1.92, 1.94, 1.97, 1.98, 1.99, 2.0]\n"
      "[integrate]\nsettle = 100\nrecord = 120\nextend = 1\n",
      {kUndecided, kPeriodic, kQuasiPeriodic});
}

// From the start, where transients are taken for motions most easily.
TEST(ReferenceOrbits, AreThoseOfTheKernelInTransients) {
  expect_engines_agree(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.6\nto = 1.0\ncount = 33\n"
      "[integrate]\nsettle = 0\nrecord = 120\nextend = 1\n",
      {kUndecided, kPeriodic});
}

// Longer windows for what the first left undecided; `settled` counts the windows before.
TEST(ReferenceOrbits, AreThoseOfTheKernelInLongerWindows) {
  expect_engines_agree(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.82, 1.9, 1.99]\n"
      "[integrate]\nsettle = 100\nrecord = 120\nextend = 4\n",
      {kPeriodic, kQuasiPeriodic});
}

// Chaos with 8 times its standard error or more.
TEST(ReferenceOrbits, AreThoseOfTheKernelInChaos) {
  expect_engines_agree(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\n"
      "values = [1.3, 1.32, 1.34, 1.36, 1.38, 1.4]\n[integrate]\nsettle = 100\nrecord = 600\n"
      "extend = 1\n",
      {kChaotic});
}

}  // namespace
}  // namespace gearsweep::testing
