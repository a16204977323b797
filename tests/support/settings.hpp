// Reads and writes a ModelSetting by the names of the model's parameters and options.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "model/model.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::testing {

inline const Model& gear5() { return *find_model("gear5"); }

inline std::size_t parameter_index(const Model& model, const std::string& name) {
  const int index = model.find_parameter(name);
  if (index < 0) throw std::logic_error("no parameter " + name);
  return static_cast<std::size_t>(index);
}

inline std::size_t state_index(const Model& model, const std::string& name) {
  const int index = model.find_state(name);
  if (index < 0) throw std::logic_error("no state " + name);
  return static_cast<std::size_t>(index);
}

inline std::size_t signal_index(const Model& model, const std::string& name) {
  const int index = model.find_signal(name);
  if (index < 0) throw std::logic_error("no signal " + name);
  return static_cast<std::size_t>(index);
}

inline double parameter_of(const ModelSetting& setting, const std::string& name) {
  return setting.parameters[parameter_index(gear5(), name)];
}

inline void set_parameter(ModelSetting* setting, const std::string& name, double value) {
  setting->parameters[parameter_index(gear5(), name)] = value;
}

inline std::string option_of(const ModelSetting& setting, const std::string& name) {
  const auto index = static_cast<std::size_t>(gear5().find_option(name));
  return gear5().options[index].choices[static_cast<std::size_t>(setting.options[index])];
}

inline void set_option(ModelSetting* setting, const std::string& name, const std::string& choice) {
  const auto index = static_cast<std::size_t>(gear5().find_option(name));
  const std::vector<std::string>& choices = gear5().options[index].choices;
  const auto found = std::find(choices.begin(), choices.end(), choice);
  if (found == choices.end()) throw std::logic_error("no choice " + choice);
  setting->options[index] = static_cast<int>(found - choices.begin());
}

}  // namespace gearsweep::testing
