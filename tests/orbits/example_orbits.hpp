// Settled orbits of the textbook models and of gear5, to be examined by the tests of this folder.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "orbits/continuation.hpp"
#include "orbits/find_orbit.hpp"
#include "study/builtin_models.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {

// These many steps per period leave less than 1e-8 in what these tests look at, unless they say
// otherwise (see LocatedPointsHardlyDependOnTheSteps).
constexpr std::size_t kSteps = 1024;
// Enough for the 8 digits after the point that points of pendulum and Duffing are published with,
// of which 2e-8 is asked for.
constexpr std::size_t kFewSteps = 512;
constexpr double kPublished = 2e-8;

// A model with parameters that differ from its defaults, and options.
struct Example {
  const Model* model;
  ModelSetting setting;

  Example(const std::string& name, const std::map<std::string, double>& parameters,
          const std::map<std::string, std::string>& options = {})
      : model(find_model(name)), setting(model->default_setting()) {
    for (const auto& [parameter, value] : parameters) {
      setting.parameters[parameter_index(*model, parameter)] = value;
    }
    for (const auto& [option, choice] : options) {
      const auto index = static_cast<std::size_t>(model->find_option(option));
      const std::vector<std::string>& choices = model->options[index].choices;
      const auto found = std::find(choices.begin(), choices.end(), choice);
      setting.options[index] = static_cast<int>(found - choices.begin());
    }
  }

  PeriodMap map(std::size_t steps = kSteps) const { return PeriodMap(*model, setting, steps); }

  // The orbit that the model's equilibrium settles on; `periods` is enough for it to settle. Long
  // steps lead near it, some short ones forget their error, and Newton's method does the rest.
  Orbit orbit(std::size_t periods, std::size_t steps = kSteps) const {
    return orbit_from(model->equilibrium(setting), periods, steps);
  }
  Orbit orbit_from(const std::vector<double>& start, std::size_t periods,
                   std::size_t steps = kSteps) const {
    const Eigen::VectorXd state =
        Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
    const Eigen::VectorXd near =
        map(std::min<std::size_t>(steps, 256)).advance(state, periods).value();
    const PeriodMap period_map = map(steps);
    return find_orbit(period_map, period_map.advance(near, 40).value(), std::nullopt);
  }

  Branch follow(const Orbit& start, const std::string& parameter, double from, double to,
                bool upwards, std::size_t steps = kSteps) const {
    return follow_orbit(
        {model, setting, parameter_index(*model, parameter), from, to, steps, upwards}, start);
  }
};

// gear1 with square-wave stiffness 1 -+ k, soft for the first `share` of the period, and no
// transmission error: it stays in contact, so that its tangent obeys Meissner's equation.
inline Example meissner(double omega) {
  return Example("gear1",
                 {{"omega", omega},
                  {"z", 0.05},
                  {"Fm", 0.1},
                  {"Fte", 0.0},
                  {"Fte_2", 0.0},
                  {"Fte_3", 0.0},
                  {"k", 0.3},
                  {"k_2", 0.0},
                  {"k_3", 0.0},
                  {"share", 0.4}},
                 {{"stiffness", "square"}});
}

}  // namespace gearsweep::testing
