// Extremes and averages look inside the steps: with every model, at random parameters and starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "support/each_model.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

// Parameters that hang together: shares add up, teeth and cycles are whole, and a frequency follows
// from stiffness and inertia.
constexpr const char* kBound[] = {"rho_", "k0_", "varpi_", "zp_", "z_", "teeth_ratio_", "cycle"};

// The model at parameters of 0.7 to 1.4 times its defaults, over starts of its first state, for two
// periods: too few for chaos to part two runs.
std::string any_study(const Model& model, std::mt19937* random) {
  std::uniform_real_distribution<double> factor(0.7, 1.4);
  const std::string first = model.states.front().name;
  std::string toml = "[model]\nname = '" + model.name + "'\n[parameters]\n";
  ModelSetting setting = model.default_setting();
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    const double value = std::clamp(info.default_value * factor(*random), info.min, info.max);
    const bool is_bound = std::ranges::any_of(
        kBound, [&](const char* begin) { return info.name.starts_with(begin); });
    if (info.shapes_phase || value == 0.0 || is_bound || model.find_derived(i)) continue;
    // One gear of two drawings has one base circle.
    ModelSetting changed = setting;
    changed.parameters[i] = value;
    if (model.check && !model.check(changed).empty()) continue;
    setting = changed;
    toml += info.name + " = " + digits(value) + "\n";
  }
  toml += "[[axes]]\nname = '" + first +
          "'\nfrom = -1.9\nto = 2.1\ncount = 16\n[integrate]\nsettle = 1\nrecord = 1\n"
          "stop = 'never'\n";
  return toml + observe_all_of(model);
}

// The median error of all quantities and points, relative to the size of each quantity, with steps
// of so many times the default. A quantity that is nothing but rounding (the highest place below a
// wall at 0) says nothing of an order.
double median_error(const std::string& study, const Model& model, double steps,
                    const SweepResult& fine) {
  const SweepResult result = run(study, {"integrate.max_step=" + digits(steps * model.max_step)});
  std::vector<double> errors;
  for (std::size_t i = 0; i < fine.values.size(); ++i) {
    double size = 0.0;
    for (const double value : fine.values[i]) size = std::max(size, std::abs(value));
    for (std::size_t point = 0; point < fine.status.size() && size > 1e-9; ++point) {
      errors.push_back(std::abs(result.values[i][point] - fine.values[i][point]) / size);
    }
  }
  // What does not change at all says nothing of an order.
  std::erase_if(errors, [](double error) { return !(error > 1e-13); });
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

// At the ends of the steps alone extremes would be of second order, and so would averages by the
// trapezoidal rule where the equations jump: half the step would leave a quarter.
class InsideSteps : public OfEachModel {};

TEST_P(InsideSteps, ExtremesAndAveragesAreOfFourthOrder) {
  const Model& model = its_model();
  // Two periods of so many meshes are enough for chaos. Known answers judge these models.
  if (model.mesh_periods(model.default_setting()) > 10.0) GTEST_SKIP();
  std::mt19937 random(20261123);
  double coarse = 0.0, usual = 0.0, compared = 0.0;
  // To find the clock of a model that has none takes longer than all else here.
  for (int i = 0; i < (model.is_clockless ? 2 : 3); ++i) {
    const std::string study = any_study(model, &random);
    SCOPED_TRACE(study);
    const SweepResult fine = run(study, {"integrate.max_step=" + digits(model.max_step / 8.0)});
    // A clock that is a part of a slow cycle is a number of steps: other steps, another record.
    if (fine.study.clock_reason == "a part of a return") continue;
    const double at_twice = median_error(study, model, 2.0, fine);
    const double at_once = median_error(study, model, 1.0, fine);
    coarse += std::log2(at_twice);
    usual += std::log2(at_once);
    compared += 1.0;
    EXPECT_LT(at_once, 1e-4);
  }
  // A force of the power 3/2 bends without limit where it begins: steps there are of order 5/2.
  // Without forcing, averages look through a window that has one weight for a step: of second
  // order in the step over the record, which is short here.
  const bool has_window = model.is_clockless;
  const double order = has_window ? 1.5 : model.name == "hertz" ? 2.3 : 3.5;
  if (compared == 0.0) GTEST_SKIP();
  EXPECT_GT((coarse - usual) / compared, order) << "mean order of " << compared;
}

INSTANTIATE_TEST_SUITE_P(Few, InsideSteps, ::testing::ValuesIn(few_models()), name_of_model);
INSTANTIATE_TEST_SUITE_P(Others, InsideSteps, ::testing::ValuesIn(other_models()), name_of_model);

}  // namespace
}  // namespace gearsweep::testing
