// Results of any study, of numbers without any order: what a file of them takes, and what it calls
// them, does not depend on an engine.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <random>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "engine/trace.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::testing {

// Every quantity that a model offers, as observe.quantities has them.
inline std::string all_quantities(const Model& model) {
  std::vector<std::string> names;
  for (const Quantity& quantity : offered_quantities(model)) names.push_back(quantity.name);
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

// All states, as observe.poincare has them.
inline std::string all_states(const Model& model) {
  std::vector<std::string> names;
  for (const ChannelInfo& state : model.states) names.push_back(state.name);
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

// What a model lets a study sweep.
inline std::vector<std::string> sweepable(const Model& model) {
  std::vector<std::string> names;
  for (const ParameterInfo& info : model.parameters) names.push_back(info.name);
  for (const ChannelInfo& info : model.states) names.push_back(info.name);
  return names;
}

// Over one value of each axis, of all that a study can ask for.
inline Study study_of_all(const Model& model, const std::vector<std::string>& axes) {
  std::string toml = find_model(model.name) != nullptr
                         ? fmt::format("[model]\nname = '{}'\n", model.name)
                         : fmt::format("[model]\ntext = '''{}'''\n", model.text);
  for (const std::string& axis : axes) {
    const int parameter = model.find_parameter(axis);
    const double value =
        parameter < 0 ? 0.5 : model.parameters[static_cast<std::size_t>(parameter)].default_value;
    toml += fmt::format("[[axes]]\nname = '{}'\nvalues = [{}]\n", axis, value);
  }
  toml += "[initial]\nensemble = 2\n[integrate]\nrecord = 2\n";
  toml += fmt::format("[observe]\nquantities = {}\npoincare = {}\n", all_quantities(model),
                      all_states(model));
  return read_study(toml, "test");
}

// Two moments of every channel that a trace has.
inline Trace trace_of_all(const Study& study) {
  Trace trace;
  trace.setting = study.setting;
  trace.period = 1.0;
  trace.tau = {0.0, 1.0};
  for (const auto& list :
       {study.model->states, study.model->signals, {{"contact", "1", "flank"}}}) {
    for (const ChannelInfo& channel : list) {
      trace.channels.push_back(channel);
      trace.values.push_back({1.0, 2.0});
    }
  }
  return trace;
}

// `attractors`: so many in the list of a study that has one.
inline SweepResult random_result(const Study& study, std::size_t attractors,
                                 std::mt19937_64* random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto numbers = [&](std::size_t count) {
    std::vector<double> out(count);
    for (double& value : out) value = number(*random);
    return out;
  };
  SweepResult result;
  result.study = study;
  result.engine = {"a device", "a driver", "-DLANES=8"};
  for (std::size_t i = 0; i < study.points(); ++i) {
    result.status.push_back(static_cast<std::uint8_t>((*random)() % 3));
  }
  for (const Quantity& quantity : study.selection.quantities) {
    result.values.push_back(numbers(study.points() * quantity.width));
    if (quantity.flags.empty()) continue;
    for (double& value : result.values.back()) {
      value = static_cast<double>((*random)() % quantity.flags.size());
    }
  }
  result.samples =
      numbers(study.points() * study.selection.poincare.size() * study.integrate.record);
  if (!study.selection.census) return result;
  for (std::size_t i = 0; i < attractors; ++i) {
    result.attractors.push_back(
        {0, number(*random), number(*random), number(*random), number(*random), 1});
  }
  return result;
}

}  // namespace gearsweep::testing
