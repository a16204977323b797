#include "cli/detail/place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plan/plan.hpp"

namespace gearsweep {

double to_number(const std::string& text, const std::string& option) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::logic_error&) {
    // Said below, with the rest of what is no number.
  }
  throw InputError(fmt::format("{}: '{}' is not a number", option, text));
}

// "name=rest" in two.
std::pair<std::string, std::string> split_assignment(const std::string& text,
                                                     const std::string& option,
                                                     const std::string& example) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("{}: '{}' is not of the form {}", option, text, example));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::size_t parameter_index(const Model& model, const std::string& name,
                            const std::string& option) {
  const int index = model.find_parameter(name);
  if (index >= 0) return static_cast<std::size_t>(index);
  std::vector<std::string> known;
  for (const ParameterInfo& parameter : model.parameters) known.push_back(parameter.name);
  throw InputError(fmt::format("{}: unknown parameter '{}' of model '{}'{}", option, name,
                               model.name, suggest_name(name, known)));
}

void require_in_range(const ParameterInfo& info, double value, const std::string& option) {
  if (value >= info.min && value <= info.max) return;
  throw InputError(fmt::format("{}: {} = {} is out of range; {} .. {} is allowed", option,
                               info.name, value, info.min, info.max));
}

std::vector<Placed> read_place(const Model& model, const std::vector<std::string>& at) {
  std::vector<Placed> place;
  for (const std::string& assignment : at) {
    const auto [name, text] = split_assignment(assignment, "--at", "omega=0.7");
    const double value = to_number(text, "--at");
    const int state = model.find_state(name);
    if (state >= 0) {
      place.push_back({true, static_cast<std::size_t>(state), value});
      continue;
    }
    place.push_back({false, parameter_index(model, name, "--at"), value});
    require_in_range(model.parameters[place.back().index], value, "--at");
  }
  return place;
}

void place_parameters(const std::vector<Placed>& place, Study* study) {
  for (const Placed& placed : place) {
    if (!placed.is_state) study->setting.parameters[placed.index] = placed.value;
  }
  for (Axis& axis : study->axes) {
    const auto given = std::find_if(place.begin(), place.end(), [&](const Placed& placed) {
      return placed.is_state == axis.is_state && placed.index == axis.index;
    });
    if (given != place.end()) {
      axis.values = {given->value};
    } else if (axis.values.size() > 1) {
      throw InputError(fmt::format("--at gives no value for the study's axis '{}': add {}={}",
                                   axis.name, axis.name, axis.values.front()));
    } else if (!axis.is_state) {
      study->setting.parameters[axis.index] = axis.values.front();
    }
  }
}

void place_states(const std::vector<Placed>& place, Study* study) {
  study->initial.state = Plan(*study, 1).own_initial_state(0);
  study->initial.policy = InitialPolicy::fixed;
  for (const Placed& placed : place) {
    if (placed.is_state) study->initial.state[placed.index] = placed.value;
  }
}

}  // namespace gearsweep
