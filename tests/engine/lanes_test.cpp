// Points that share a work-item have the numbers that each has alone: all quantities of all models.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/observable.hpp"
#include "support/each_model.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

class LanesOf : public OfEachModel {};

// All that needs no ensemble.
std::string each_quantity(const Model& model) {
  std::vector<std::string> names;
  for (const Quantity& quantity : offered_quantities(model)) {
    if (!quantity.of_census) names.push_back(quantity.name);
  }
  return fmt::format("['{}']", fmt::join(names, "', '"));
}

// Eight values of the first parameter that is not 0.
std::string own_axis(const Model& model) {
  const auto info = std::ranges::find_if(
      model.parameters, [](const ParameterInfo& one) { return one.default_value != 0.0; });
  const double value = info->default_value;
  return fmt::format("name = '{}'\nfrom = {}\nto = {}\ncount = 8\n", info->name,
                     std::clamp(0.95 * value, info->min, info->max),
                     std::clamp(1.05 * value, info->min, info->max));
}

// To rounding: functions of one number and of several may differ in their last digit. An angle of
// what is 0 is any.
TEST_P(LanesOf, ChangeNoQuantity) {
  const Model& model = its_model();
  const std::string study = fmt::format(
      "[model]\nname = '{}'\n[[axes]]\n{}[integrate]\nsettle = 20\nrecord = 20\nwarm_up = 10\n"
      "stop = 'never'\nextend = 1\n[observe]\nquantities = {}\n",
      model.name, own_axis(model), each_quantity(model));
  const SweepResult alone = run(study, {"integrate.lanes=1"});
  const SweepResult together = run(study, {"integrate.lanes=8"});
  EXPECT_EQ(alone.status, together.status);
  for (std::size_t q = 0; q < alone.values.size(); ++q) {
    const Quantity& quantity = alone.study.selection.quantities[q];
    if (quantity.role == OutputRole::angle) continue;
    double size = 0.0;
    for (const double value : alone.values[q]) {
      if (std::isfinite(value)) size = std::max(size, std::abs(value));
    }
    for (std::size_t i = 0; i < alone.values[q].size(); ++i) {
      const double one = alone.values[q][i], other = together.values[q][i];
      if (one == other || (std::isnan(one) && std::isnan(other))) continue;
      EXPECT_NEAR(one, other, 1e-10 * size + 1e-13) << quantity.name << ' ' << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Few, LanesOf, ::testing::Values("coulomb", "gear5"), name_of_model);

std::vector<std::string> all_but_few() {
  std::vector<std::string> names = model_names();
  std::erase_if(names, [](const auto& name) { return name == "coulomb" || name == "gear5"; });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Others, LanesOf, ::testing::ValuesIn(all_but_few()), name_of_model);

}  // namespace
}  // namespace gearsweep::testing
