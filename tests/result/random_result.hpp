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

// A value that it may have.
inline double value_of(const Model& model, const std::string& name) {
  const int parameter = model.find_parameter(name);
  return parameter < 0 ? 0.5 : model.parameters[static_cast<std::size_t>(parameter)].default_value;
}

// A study that asks for all that it can, at the places of these tables.
inline Study study_at(const Model& model, const std::string& places) {
  const std::string own = find_model(model.name) != nullptr
                              ? fmt::format("name = '{}'", model.name)
                              : fmt::format("text = '''{}'''", model.text);
  return read_study(fmt::format("[model]\n{}\n{}[initial]\nensemble = 2\n[integrate]\nrecord = 2\n"
                                "[observe]\nquantities = {}\npoincare = {}\n",
                                own, places, all_quantities(model), all_states(model)),
                    "test");
}

// Over one value of each axis.
inline Study study_of_all(const Model& model, const std::vector<std::string>& axes) {
  std::string tables;
  for (const std::string& axis : axes) {
    tables += fmt::format("[[axes]]\nname = '{}'\nvalues = [{}]\n", axis, value_of(model, axis));
  }
  return study_at(model, tables);
}

// A study over each parameter and each initial state alone. The model is read once, with all
// of them in a list of points: it takes longer than all else that is done here.
inline std::vector<Study> studies_over_each(const Model& model) {
  const std::vector<std::string> names = sweepable(model);
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(value_of(model, name));
  const Study all = study_at(model, fmt::format("[points]\nnames = ['{}']\nnumbers = '{}'\n",
                                                fmt::join(names, "', '"), fmt::join(values, ", ")));
  std::vector<Study> studies;
  for (const Swept& column : all.axes.at(0).columns) {
    Study study = all;
    study.axes.assign(1, Axis());
    static_cast<Swept&>(study.axes.front()) = column;
    studies.push_back(std::move(study));
  }
  return studies;
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
