#include "point/place.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plan/plan.hpp"

namespace gearsweep {
namespace {

double nearest_value(const Axis& axis, double value) {
  return *std::ranges::min_element(axis.values, {},
                                   [&](double own) { return std::abs(own - value); });
}

// The place's value of the axis; nullptr where it gives none.
template <class AnyPlace>
auto* value_on(const Axis& axis, AnyPlace* place) {
  auto named = place->named.find(axis.name);
  if (named != place->named.end()) return &named->second;
  decltype(&named->second) value = nullptr;
  for (auto& placed : place->values) {
    if (axis.columns.empty() && is_swept(axis, placed)) value = &placed.value;
  }
  return value;
}

const std::string& name_of(const Model& model, const Placed& placed) {
  return placed.is_state ? model.states[placed.index].name : model.parameters[placed.index].name;
}

[[noreturn]] void refuse_missing(const Axis& axis, const std::string& origin) {
  throw InputError(fmt::format("{} value for the study's axis '{}': add {}={}",
                               origin.empty() ? "there is no" : origin + " gives no", axis.name,
                               axis.name, axis.values.front()));
}

const Axis* find_axis_of_several(const Study& study, const std::string& name) {
  const auto found = std::ranges::find_if(
      study.axes, [&](const Axis& axis) { return !axis.columns.empty() && axis.name == name; });
  return found == study.axes.end() ? nullptr : &*found;
}

const Placed* find_placed(const Place& place, const Swept& swept) {
  const auto given = std::ranges::find_if(place.values, [&](const Placed& placed) {
    return placed.is_state == swept.is_state && placed.index == swept.index;
  });
  return given == place.values.end() ? nullptr : &*given;
}

// The axis, which stands for several parameters, at one of its values. Those of a key of [gear] may
// lie between the ones that it has: the study is read again for them.
Axis at_value(const Study& study, const Axis& axis, double value, const std::string& origin) {
  const auto own = std::ranges::find(axis.values, value);
  if (own != axis.values.end()) {
    return axis.at({static_cast<std::size_t>(own - axis.values.begin())});
  }
  if (axis.is_list) {
    throw InputError(
        told_of(origin, fmt::format("there is no point {}; points are numbered from {} to {}",
                                    value, axis.values.front(), axis.values.back())));
  }
  const std::string zoom = fmt::format("{}={}:{}:1", axis.name, value, value);
  try {
    return *find_axis_of_several(read_study(study.toml, "study", {}, {zoom}), axis.name);
  } catch (const InputError& error) {
    const std::string told = error.what();
    const std::string reason = told.substr(told.find(": ") + 2);  // without the place
    throw InputError(told_of(origin, fmt::format("{} = {}: {}", axis.name, value, reason)));
  }
}

// The same at the place, with what that says of single parameters.
Axis placed_columns(const Study& study, const Axis& axis, const Place& place) {
  const auto named = place.named.find(axis.name);
  const bool are_all_placed = std::ranges::all_of(
      axis.columns, [&](const Swept& column) { return find_placed(place, column) != nullptr; });
  if (named == place.named.end() && axis.values.size() > 1 && !are_all_placed) {
    refuse_missing(axis, place.origin);
  }
  Axis placed = named == place.named.end() ? axis.at({0})
                                           : at_value(study, axis, named->second, place.origin);
  for (Swept& column : placed.columns) {
    const Placed* given = find_placed(place, column);
    if (given != nullptr) column.values = {given->value};
  }
  return placed;
}

}  // namespace

std::string told_of(const std::string& origin, const std::string& text) {
  return origin.empty() ? text : origin + ": " + text;
}

std::size_t parameter_index(const Model& model, const std::string& name,
                            const std::string& origin) {
  const int index = model.find_parameter(name);
  if (index >= 0) return static_cast<std::size_t>(index);
  if (std::ranges::find(model.constants, name, &ConstantInfo::name) != model.constants.end()) {
    throw InputError(told_of(
        origin, fmt::format("'{}' is a constant of model '{}'; where it is a plain number, --set "
                            "parameters.{}=VALUE makes it a parameter",
                            name, model.name, name)));
  }
  std::vector<std::string> known;
  for (const ParameterInfo& parameter : model.parameters) known.push_back(parameter.name);
  throw InputError(told_of(origin, fmt::format("unknown parameter '{}' of model '{}'{}", name,
                                               model.name, suggest_name(name, known))));
}

void require_in_range(const ParameterInfo& info, double value, const std::string& origin) {
  if (value >= info.min && value <= info.max) return;
  throw InputError(told_of(origin, fmt::format("{} = {} is out of range; {} .. {} is allowed",
                                               info.name, value, info.min, info.max)));
}

Place find_place(const Study& study, const std::vector<NamedValue>& values,
                 const std::string& origin) {
  const Model& model = *study.model;
  Place place{{}, {}, origin};
  for (const auto& [name, value] : values) {
    if (find_axis_of_several(study, name) != nullptr) {
      place.named[name] = value;
      continue;
    }
    const int state = model.find_state(name);
    if (state < 0) {
      place.values.push_back({false, parameter_index(model, name, origin), value});
      require_in_range(model.parameters[place.values.back().index], value, origin);
    } else if (std::isfinite(value)) {
      place.values.push_back({true, static_cast<std::size_t>(state), value});
    } else {
      throw InputError(told_of(origin, fmt::format("{} = {} is not finite", name, value)));
    }
  }
  return place;
}

std::optional<double> own_value(const Study& study, const Axis& axis) {
  if (axis.columns.empty()) {
    if (axis.is_state) return std::nullopt;
    return study.setting.parameters[axis.index];
  }
  // What axes of [gear], or of [gear.first], end in: these are called KEY_first.
  std::map<std::string, std::string> suffixes = {{"[gear]", ""}};
  for (const std::string& name : study.model->drawings) {
    suffixes[fmt::format("[gear.{}]", name)] = "_" + name;
  }
  auto table = suffixes.end();
  for (const std::string& line : split(study.toml, '\n')) {
    if (line.starts_with('[')) table = suffixes.find(line);
    if (table == suffixes.end() || !axis.name.ends_with(table->second)) continue;
    const std::string start = axis.name.substr(0, axis.name.size() - table->second.size()) + " = ";
    if (!line.starts_with(start)) continue;
    const char* text = line.c_str() + start.size();
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end != text && *end == '\0') return value;
  }
  return std::nullopt;
}

bool is_swept(const Axis& axis, const Placed& placed) {
  return std::ranges::any_of(axis.swept(), [&](const Swept& swept) {
    return swept.is_state == placed.is_state && swept.index == placed.index;
  });
}

void place_parameters(const Place& place, Study* study) {
  study->take_nominal();
  for (const Placed& placed : place.values) {
    if (placed.is_state) continue;
    study->release(placed.index);
    study->setting.parameters[placed.index] = placed.value;
  }
  if (study->axes.empty()) study->axes.push_back(resting_axis(*study));
  const Study whole = *study;
  for (Axis& axis : study->axes) {
    const Placed* given = axis.columns.empty() ? find_placed(place, axis) : nullptr;
    if (!axis.columns.empty()) {
      axis = placed_columns(whole, axis, place);
    } else if (given != nullptr) {
      axis.values = {given->value};
    } else if (axis.values.size() > 1) {
      refuse_missing(axis, place.origin);
    }
    for (const Swept& swept : axis.swept()) {
      if (!swept.is_state) study->setting.parameters[swept.index] = swept.values.front();
    }
  }
  study->model->derive(&study->setting);
}

void place_states(const Place& place, Study* study) {
  study->initial.state = Plan(*study, 1).own_initial_state(0);
  study->initial.policy = InitialPolicy::fixed;
  for (const Placed& placed : place.values) {
    if (placed.is_state) study->initial.state[placed.index] = placed.value;
  }
}

std::string move_to_chain(const Study& whole, Place* place) {
  if (!whole.is_chained() || whole.axes.empty()) return "";
  const Axis& axis = whole.axes[whole.initial.along];
  double* value = axis.is_list ? nullptr : value_on(axis, place);
  if (value == nullptr) return "";
  if (*value < axis.values.front() || *value > axis.values.back()) {
    throw InputError(
        told_of(place->origin, fmt::format("{} = {} is beyond the axis, {} .. {}", axis.name,
                                           *value, axis.values.front(), axis.values.back())));
  }
  const double nearest = nearest_value(axis, *value);
  if (nearest == *value) return "";
  const std::string told = fmt::format(
      "{} = {} is taken for {}: the points of this study go on from their neighbours "
      "along '{}', so only they can be followed",
      axis.name, *value, nearest, axis.name);
  *value = nearest;
  return told_of(place->origin, told);
}

std::string nearest_point(const Study& whole, const Place& place) {
  std::vector<std::string> values;
  bool is_point = true;
  for (const Axis& axis : whole.axes) {
    const double* value = value_on(axis, &place);
    if (value == nullptr) continue;
    const double nearest = nearest_value(axis, *value);
    is_point = is_point && nearest == *value;
    values.push_back(fmt::format("{}={}", axis.name, nearest));
  }
  return is_point ? "" : fmt::format("{}", fmt::join(values, ","));
}

std::string label_of(const Model& model, const Place& place) {
  std::string label;
  const auto add = [&](const std::string& name, double value) {
    label += fmt::format("{}{}={:.6g}", label.empty() ? "" : ", ", name, value);
  };
  for (const auto& [name, value] : place.named) add(name, value);
  for (const Placed& placed : place.values) add(name_of(model, placed), placed.value);
  return label;
}

}  // namespace gearsweep
