// Models of equations as headers that were written by hand, before they became files.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// A function of the phase of its own period, in [0, 1]. At a jump it has the value of the side on
// which `toward` lies.
struct Curve {
  std::function<double(double phase, double toward)> at;  // empty where nothing is measured
  std::vector<double> jumps;                              // phases; also where it bends
};

const std::vector<Model>& handwritten_models();

// A setting of one model as one of another that has its parameters and options, in any order.
// Throws std::out_of_range.
inline ModelSetting translated(const Model& from, const ModelSetting& values, const Model& to) {
  const auto at = [](int index) {
    if (index < 0) throw std::out_of_range("no such parameter or option");
    return static_cast<std::size_t>(index);
  };
  ModelSetting setting = to.default_setting();
  for (std::size_t i = 0; i < setting.parameters.size(); ++i) {
    setting.parameters[i] = values.parameters[at(from.find_parameter(to.parameters[i].name))];
  }
  for (std::size_t i = 0; i < setting.options.size(); ++i) {
    setting.options[i] = values.options[at(from.find_option(to.options[i].name))];
  }
  return setting;
}

}  // namespace gearsweep
