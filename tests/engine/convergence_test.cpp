// The order of convergence, measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "engine/outside_gear5.hpp"
#include "plan/plan.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// The teeth stay in contact. With contact ratio 1.5 the break phases are 0, 1/2 and 3/4, so that
// all segments are whole numbers of the same step, which halves exactly.
const std::string kStudy =
    "[model]\nstiffness = 'rectangular'\nbacklash = 'dynamic'\n[parameters]\neps = 1.5\n"
    "e0 = 0.05\nmu = 0.1\n[[axes]]\nname = 'omega'\nvalues = [0.8]\n[integrate]\nsettle = 4\n"
    "record = 1\nstop = 'never'\n" +
    kObserveGear5;

// The teeth part and meet again in each period, on one flank or, with the small backlash, on both;
// with a small dynamic backlash both touch at once.
std::string parting(const std::string& backlash, const std::string& b,
                    const std::string& omega = "1.0") {
  return "[model]\npreset = 'coarse'\nbacklash = '" + backlash +
         "'\n[parameters]\neps = 1.5\nb = " + b + "\n[[axes]]\nname = 'omega'\nvalues = [" + omega +
         "]\n[integrate]\nsettle = 4\nrecord = 1\nstop = 'never'\n" + kObserveGear5;
}

// Largest error of a state after five periods, for 32, 64, ... steps per period, against odeint's
// Dormand-Prince at 1e-15: its error, at most 1e-11 where the teeth part, is far below the finest
// run's.
std::vector<double> errors(const std::string& study, const std::string& engine,
                           const std::string& events, double contact_class) {
  std::vector<double> found;
  std::optional<OutsideState> exact;
  for (const char* steps : {"32", "64", "128", "256", "512"}) {
    const SweepResult result =
        run(study, {"integrate.engine='" + engine + "'", "integrate.events=" + events,
                    "integrate.steps_per_period=" + std::string(steps)});
    EXPECT_EQ(map_of(result, "contact_class")[0], contact_class);
    const Plan plan(result.study, 1);
    EXPECT_EQ(plan.phase_grid_of(0).steps, std::stoul(steps));
    if (!exact) {
      const OutsideGear gear(plan.setting_of(0));
      exact = outside_state(plan.own_initial_state(0));
      for (int period = 0; period < 5; ++period) gear.advance_period(1e-15, &*exact);
    }
    double error = 0.0;
    for (std::size_t i = 0; i < 10; ++i) {
      error = std::max(error, std::abs(samples_of(result, 0, i)[0] - (*exact)[i]));
    }
    found.push_back(error);
  }
  return found;
}

// Each halving divides the error by 2^p. At 32 steps the next power of the step still shows (0.1 in
// p), later less: from 3.8 to 4.3 each, and the last within 0.1 of 4.
void expect_fourth_order(const std::vector<double>& found) {
  for (std::size_t i = 0; i + 1 < found.size(); ++i) {
    const double order = std::log2(found[i] / found[i + 1]);
    EXPECT_GT(order, 3.8) << "halving " << i;
    EXPECT_LT(order, 4.3) << "halving " << i;
  }
  EXPECT_NEAR(std::log2(found[3] / found[4]), 4.0, 0.1);
}

TEST(Convergence, KernelIsOfFourthOrder) {
  expect_fourth_order(errors(kStudy, "opencl", "true", 0.0));
}

// Pairs take up their load over a quarter of a base pitch: that bends the stiffness at 1/4 again,
// and at 1/4 before they leave.
TEST(Convergence, KernelIsOfFourthOrderWhereTeethTakeUpTheirLoad) {
  std::string gradual = kStudy;
  gradual.insert(gradual.find("e0 = "), "engagement = 0.25\n");
  expect_fourth_order(errors(gradual, "opencl", "true", 0.0));
}

TEST(Convergence, ReferenceEngineIsOfFourthOrder) {
  expect_fourth_order(errors(kStudy, "reference", "true", 0.0));
}

// Where in a step a limit is crossed depends on the step's length, so that the ratios of single
// halvings scatter; over four halvings the mean order is 4 within 0.5. Without the correction it is
// about 2, and the error at 512 steps more than a hundred times larger.
void expect_fourth_order_where_teeth_part(const std::string& study, const std::string& engine,
                                          double contact_class) {
  const std::vector<double> found = errors(study, engine, "true", contact_class);
  EXPECT_NEAR(std::log2(found.front() / found.back()) / 4.0, 4.0, 0.5);
  const std::vector<double> plain = errors(study, engine, "false", contact_class);
  EXPECT_LT(std::log2(plain.front() / plain.back()) / 4.0, 3.0);
  EXPECT_GT(plain.back(), 100.0 * found.back());
}

TEST(Convergence, IsOfFourthOrderWhereTeethPart) {
  for (const std::string engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    expect_fourth_order_where_teeth_part(parting("constant", "1.0"), engine, 1.0);
    expect_fourth_order_where_teeth_part(parting("dynamic", "1.0"), engine, 1.0);
    expect_fourth_order_where_teeth_part(parting("constant", "0.05"), engine, 2.0);
    expect_fourth_order_where_teeth_part(parting("dynamic", "0.02", "0.7"), engine, 3.0);
    expect_fourth_order_where_teeth_part(parting("dynamic", "0.02", "1.1"), engine, 3.0);
  }
}

// Extremes and contact shares of the fifth period, whose trajectory is of fourth order, too. Where
// in a step they lie depends on its length, so the order is the mean of three halvings. Shares are
// of third order: the deflection's third derivative jumps where teeth meet.
TEST(Convergence, ExtremesAndSharesInsideStepsConverge) {
  const std::vector<std::string> quantities = {"x1_min", "x1_max", "contact_drive", "contact_back"};
  for (const std::string engine : {"opencl", "reference"}) {
    std::array<std::vector<double>, 2> orders;  // of extremes, of shares
    for (const std::string& study : {parting("constant", "1.0"), parting("dynamic", "1.0"),
                                     parting("constant", "0.05"), parting("constant", "0.3")}) {
      std::vector<std::vector<double>> found;  // [halving][quantity]
      for (const char* steps : {"32", "64", "128", "256"}) {
        const SweepResult result = run(study, {"integrate.engine='" + engine + "'",
                                               "integrate.steps_per_period=" + std::string(steps)});
        const Plan plan(result.study, 1);
        const OutsideGear gear(plan.setting_of(0));
        OutsideState exact = outside_state(plan.own_initial_state(0));
        for (int period = 0; period < 4; ++period) gear.advance_period(1e-14, &exact);
        OutsideRange range = {exact[0], exact[0]};
        gear.advance_period(1e-14, &exact, &range);
        const std::vector<double> truth = {range.min, range.max, range.drive, range.back};
        found.emplace_back();
        for (std::size_t i = 0; i < quantities.size(); ++i) {
          found.back().push_back(std::abs(map_of(result, quantities[i])[0] - truth[i]));
        }
      }
      for (std::size_t i = 0; i < quantities.size(); ++i) {
        SCOPED_TRACE(engine + " " + quantities[i] + "\n" + study);
        if (found.front()[i] == 0.0) continue;  // a flank that is never touched
        const double order = std::log2(found.front()[i] / std::max(found.back()[i], 1e-8)) / 3.0;
        if (found.front()[i] > 1e-5) orders[i < 2 ? 0 : 1].push_back(order);
        EXPECT_LT(found.back()[i], 2e-7);
      }
    }
    const auto mean = [](const std::vector<double>& values) {
      return std::accumulate(values.begin(), values.end(), 0.0) /
             static_cast<double>(values.size());
    };
    EXPECT_GT(mean(orders[0]), 3.5) << engine;
    EXPECT_GT(mean(orders[1]), 2.7) << engine;
  }
}

}  // namespace
}  // namespace gearsweep::testing
