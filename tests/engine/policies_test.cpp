// What a point starts from: the initial policies, initial-state axes; and axes that shape the
// phase.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

// None stops on an orbit: it would end one turn after its samples, which rounding tells apart. And
// the search for orbits has kernels of its own, which take as long to build as the others.
const std::string kIntegrate = "[integrate]\nsettle = 20\nrecord = 3\nstop = 'never'\n";

std::string fixed_state(const std::vector<double>& state) {
  std::string text = "{";
  for (std::size_t i = 0; i < state.size(); ++i) {
    text += (i > 0 ? ", " : "") + gear5().states[i].name + " = " + digits(state[i]);
  }
  return text + "}";
}

std::vector<double> last_state(const SweepResult& result, std::size_t point) {
  std::vector<double> state;
  for (std::size_t i = 0; i < 10; ++i) state.push_back(samples_of(result, point, i).back());
  return state;
}

// A run of a single point must give the bits of `point` of `result`.
void expect_same_point(const SweepResult& single, const SweepResult& result, std::size_t point) {
  EXPECT_EQ(single.status[0], result.status[point]);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    EXPECT_TRUE(same_bits(single.values[i][0], result.values[i][point]))
        << result.study.selection.quantities[i].name << ", point " << point;
  }
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(different_bits(samples_of(single, 0, i), samples_of(result, point, i)), 0U)
        << "point " << point;
  }
}

// The same where the axes differ: what is tabulated depends on them, so sums round differently. The
// motions part by less than a hundred times in so few periods.
void expect_near_point(const SweepResult& single, const SweepResult& result, std::size_t point) {
  EXPECT_EQ(single.status[0], result.status[point]);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    EXPECT_NEAR(single.values[i][0], result.values[i][point], 1e-12)
        << result.study.selection.quantities[i].name << ", point " << point;
  }
  for (std::size_t i = 0; i < 10; ++i) {
    const std::vector<double> own = samples_of(single, 0, i), other = samples_of(result, point, i);
    for (std::size_t k = 0; k < own.size(); ++k) EXPECT_NEAR(own[k], other[k], 1e-12);
  }
}

TEST(Policies, ShiftedIsTheStaticEquilibrium) {
  const std::string study =
      "[model]\npreset = 'consistent'\nbacklash = 'dynamic'\n[[axes]]\n"
      "name = 'F1'\nvalues = [0.2]\n" +
      kIntegrate + kObserveGear5;
  const SweepResult shifted = run(study, {"initial.policy='shifted'"});
  ModelSetting setting = shifted.study.setting;
  set_parameter(&setting, "F1", 0.2);
  const SweepResult fixed =
      run(study,
          {"initial.policy='fixed'", "initial.state=" + fixed_state(gear5().equilibrium(setting))});
  expect_same_point(fixed, shifted, 0);
}

// In the static equilibrium of the mean stiffness nothing moves: every force is balanced, for both
// formulations and both backlash laws. Rounding of a distance of 2400 half backlashes: 1e-12.
TEST(Policies, TheEquilibriumIsOne) {
  for (const char* formulation : {"consistent", "printed"}) {
    for (const char* backlash : {"constant", "dynamic"}) {
      ModelSetting setting = gear5().default_setting();
      set_option(&setting, "formulation", formulation);
      set_option(&setting, "backlash", backlash);
      set_option(&setting, "stiffness", "fourier");
      for (const char* name : {"kappa", "mu", "e0"}) set_parameter(&setting, name, 0.0);
      set_parameter(&setting, "k4", 1.1);
      std::vector<double> coefs(gear5().phase_coefs.size());
      gear5().phase_coefs_at(setting, 0.3, 0.3, coefs.data());
      const std::vector<double> rest = gear5().equilibrium(setting);
      double slope[10];
      gear5().prepare(setting)->rhs(coefs.data(), rest.data(), slope);
      for (const double component : slope) {
        EXPECT_NEAR(component, 0.0, 1e-12) << formulation << ", " << backlash;
      }
    }
  }
}

TEST(Policies, FixedIsTheGivenStateAndZeroForTheRest) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\n"
      "values = [0.9]\n" +
      kIntegrate + kObserveGear5;
  const SweepResult given = run(study, {"initial.policy='fixed'", "initial.state={x1 = 1.5}"});
  std::vector<double> state(10, 0.0);
  state[0] = 1.5;
  const SweepResult written =
      run(study, {"initial.policy='fixed'", "initial.state=" + fixed_state(state)});
  expect_same_point(given, written, 0);
}

// Each point goes on from the last state of the one before: single runs, chained by hand, give the
// same bits, chaos or not. The first of a chain starts shifted.
void expect_chain(const std::string& policy) {
  const std::string model = "[model]\npreset = 'coarse'\n";
  const std::vector<double> omega = {0.45, 0.5, 0.55, 0.6, 0.65};
  const std::vector<double> b = {0.3, 1.0};
  const SweepResult chained =
      run(model + "[[axes]]\nname = 'b'\nvalues = [0.3, 1.0]\n[[axes]]\nname = 'omega'\nvalues = " +
          digits(omega) + "\n[initial]\npolicy = '" + policy + "'\nalong = 'omega'\n" + kIntegrate +
          kObserveGear5);
  for (std::size_t column = 0; column < b.size(); ++column) {
    std::string start = "policy = 'shifted'\n";
    for (std::size_t i = 0; i < omega.size(); ++i) {
      const std::size_t row = policy == "forward" ? i : omega.size() - 1 - i;
      const SweepResult single =
          run(model + "[[axes]]\nname = 'b'\nvalues = [" + digits(b[column]) +
              "]\n[[axes]]\nname = 'omega'\nvalues = [" + digits(omega[row]) + "]\n[initial]\n" +
              start + kIntegrate + kObserveGear5);
      expect_same_point(single, chained, row * b.size() + column);
      start = "policy = 'fixed'\nstate = " + fixed_state(last_state(single, 0)) + "\n";
    }
  }
}

TEST(Policies, ForwardGoesOnFromTheNeighbourBefore) { expect_chain("forward"); }
TEST(Policies, BackwardGoesOnFromTheNeighbourBehind) { expect_chain("backward"); }

// Backlash softens: the resonance at 0.5 leans to the left, and coming down from it the motion with
// impacts persists to lower frequencies than where it sets in going up.
TEST(Policies, HysteresisAtTheResonance) {
  const std::string study =
      "[model]\npreset = 'consistent'\n[[axes]]\nname = 'omega'\nfrom = 0.40\nto = 0.50\n"
      "count = 6\n[integrate]\nsettle = 400\nrecord = 10\nstop = 'never'\n" +
      kObserveGear5;
  const std::vector<double> up = map_of(run(study, {"initial.policy='forward'"}), "x1_std");
  const std::vector<double> down = map_of(run(study, {"initial.policy='backward'"}), "x1_std");
  EXPECT_GT(down[2], up[2] + 0.1);    // omega = 0.44
  EXPECT_NEAR(down[0], up[0], 1e-6);  // one motion only at either end
  EXPECT_NEAR(down.back(), up.back(), 1e-6);
}

// A point that diverged is no start: its successor starts as the first of a chain does.
TEST(Policies, AChainGoesOnAfterADivergedPoint) {
  const std::string study =
      "[model]\npreset = 'consistent'\nformulation = 'printed'\n[parameters]\nm2 = 0.03\n"
      "[[axes]]\nname = 'm1'\nvalues = [0.03, 0.9]\n[initial]\npolicy = 'backward'\n" +
      kIntegrate + kObserveGear5;
  const SweepResult chained = run(study);
  ASSERT_EQ(chained.status[1], 1);
  expect_same_point(run(study, {"axes.m1.values=[0.03]"}), chained, 0);
}

TEST(Axes, AnInitialStateIsSetPointByPoint) {
  const std::string head = "[model]\npreset = 'coarse'\n[initial]\npolicy = 'fixed'\n";
  const std::string tail = kIntegrate + kObserveGear5;
  const SweepResult swept =
      run(head +
          "state = {v1 = 0.25}\n[[axes]]\nname = 'x1'\nvalues = [-1.5, 0.0, 1.5]\n"
          "[[axes]]\nname = 'omega'\nvalues = [0.65, 0.9]\n" +
          tail);
  for (std::size_t point = 0; point < 6; ++point) {
    const double x1 = swept.study.axes[0].values[point % 3];
    const double omega = swept.study.axes[1].values[point / 3];
    const SweepResult single = run(head + "state = {v1 = 0.25, x1 = " + digits(x1) +
                                   "}\n[[axes]]\nname = 'omega'\n"
                                   "values = [" +
                                   digits(omega) + "]\n" + tail);
    expect_same_point(single, swept, point);
  }
}

// Parameters that shape the phase coefficients go a different way to the device than the others:
// swept or set, they must mean the same.
TEST(Axes, ThatShapeThePhaseEqualSeparateRuns) {
  const std::string study =
      "[model]\npreset = 'coarse'\nformulation = 'printed'\n"
      "backlash = 'dynamic'\n[parameters]\nm1 = 0.04\nm2 = 0.04\n";
  const auto axis = [](const std::string& name, const std::string& values) {
    return "[[axes]]\nname = '" + name + "'\nvalues = [" + values + "]\n";
  };
  // Few periods: some of these motions are chaotic.
  const std::string tail = "[integrate]\nsettle = 3\nrecord = 2\nstop = 'never'\n" + kObserveGear5;
  for (const std::string& axes : {axis("eps", "1.3, 1.7") + axis("q", "0.1, 0.5"),
                                  axis("zp", "20.0, 40.0") + axis("alpha", "20.0, 25.0")}) {
    const SweepResult swept = run(study + "omega = 0.7\n" + axes + tail);
    for (std::size_t point = 0; point < 4; ++point) {
      std::vector<std::string> set;
      for (std::size_t i = 0; i < 2; ++i) {
        const Axis& one = swept.study.axes[i];
        const std::size_t index = i == 0 ? point % 2 : point / 2;
        set.push_back("parameters." + one.name + "=" + digits(one.values[index]));
      }
      const SweepResult single = run(study + axis("omega", "0.7") + tail, set);
      expect_near_point(single, swept, point);
    }
    // Each axis does something.
    const std::vector<double>& x1_rms = map_of(swept, "x1_rms");
    EXPECT_NE(x1_rms[0], x1_rms[1]) << swept.study.axes[0].name;
    EXPECT_NE(x1_rms[0], x1_rms[2]) << swept.study.axes[1].name;
  }
}

}  // namespace
}  // namespace gearsweep::testing
