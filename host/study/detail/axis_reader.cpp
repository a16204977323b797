#include "study/detail/axis_reader.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/toml_access.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

double max_values() { return find_key(study_table("axes"), "count")->max; }

// Fills what the axis has from the parameter or state that it sweeps; its allowed range.
std::pair<double, double> bind_axis(const Model& model, const toml::node& place, Axis* axis) {
  if (const int parameter = model.find_parameter(axis->name); parameter >= 0) {
    axis->index = static_cast<std::size_t>(parameter);
    const ParameterInfo& info = model.parameters[axis->index];
    axis->unit = info.unit;
    axis->meaning = info.meaning;
    return {info.min, info.max};
  }
  if (const int state = model.find_state(axis->name); state >= 0) {
    axis->index = static_cast<std::size_t>(state);
    axis->is_state = true;
    axis->unit = model.states[axis->index].unit;
    axis->meaning = "initial " + model.states[axis->index].meaning;
    return {-SWEEP_DIVERGED_BEYOND, SWEEP_DIVERGED_BEYOND};
  }
  std::vector<std::string> known;
  for (const ParameterInfo& info : model.parameters) known.push_back(info.name);
  for (const ChannelInfo& info : model.states) known.push_back(info.name);
  fail_at(place, fmt::format("axis '{}' is neither a parameter nor a state of model '{}'{}",
                             axis->name, model.name, suggest_name(axis->name, known)));
}

void check_increasing(const toml::node& place, const Axis& axis) {
  for (std::size_t i = 1; i < axis.values.size(); ++i) {
    if (!(axis.values[i] > axis.values[i - 1])) {
      fail_at(place, fmt::format("values of axis '{}' must increase, but {} follows {}", axis.name,
                                 axis.values[i], axis.values[i - 1]));
    }
  }
}

// The values between two ends, both included.
std::vector<double> spaced(double from, double to, std::size_t count, bool logarithmic) {
  std::vector<double> values(count, from);
  for (std::size_t i = 1; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
  }
  if (count > 1) values.back() = to;
  return values;
}

void read_range(const toml::node& place, TableReader* reader, std::pair<double, double> range,
                Axis* axis) {
  const toml::node* count_node = reader->find("count");
  if (reader->find("from") == nullptr || count_node == nullptr) {
    fail_at(place,
            fmt::format("axis '{}' needs from, to and count, or values = [...]", axis->name));
  }
  const double from = reader->number("from", 0.0, range.first, range.second);
  const double to = reader->number("to", from, range.first, range.second);
  // Exactly: the library's conversion of a float that no integer can be is undefined.
  const std::optional<std::int64_t> count = count_node->value_exact<std::int64_t>();
  if (!count) {
    fail_at(*count_node, fmt::format("axis '{}': count must be a whole number", axis->name));
  }
  if (*count < 1) {
    fail_at(*count_node,
            fmt::format("axis '{}' has count = {}; at least 1 is needed", axis->name, *count));
  }
  if (static_cast<double>(*count) > max_values()) {
    fail_at(*count_node, fmt::format("axis '{}' has count = {}; at most {} is possible", axis->name,
                                     *count, max_values()));
  }
  if (*count > 1 && !(to > from)) {
    fail_at(place, fmt::format("axis '{}' goes from {} to {}; 'to' must be greater than 'from' "
                               "(count = 1 makes a single value)",
                               axis->name, from, to));
  }
  if (axis->logarithmic && !(from > 0.0)) {
    fail_at(place,
            fmt::format("axis '{}' has a log scale; 'from' must be greater than 0", axis->name));
  }
  axis->values = spaced(from, to, static_cast<std::size_t>(*count), axis->logarithmic);
}

Axis read_axis(const toml::table& table, const Model& model) {
  TableReader reader(&table, study_table("axes"));
  Axis axis;
  axis.name = reader.text("name", "");
  if (axis.name.empty()) fail_at(table, "an axis needs a name = \"...\"");
  axis.logarithmic = reader.choice("scale", 0) == 1;
  reader.refuse_unknown();

  const toml::node* name_node = reader.find("name");
  const std::pair<double, double> range = bind_axis(model, *name_node, &axis);
  const toml::node* values = reader.find("values");
  if (values == nullptr) {
    read_range(table, &reader, range, &axis);
    check_increasing(table, axis);
    return axis;
  }
  for (const char* key : {"from", "to", "count"}) {
    if (const toml::node* extra = reader.find(key)) {
      fail_at(*extra, fmt::format("axis '{}' has both values and {}", axis.name, key));
    }
  }
  const toml::array* list = values->as_array();
  if (list != nullptr && static_cast<double>(list->size()) > max_values()) {
    fail_at(*values, fmt::format("axis '{}' has {} values; at most {} are possible", axis.name,
                                 list->size(), max_values()));
  }
  axis.values = reader.numbers("values", range.first, range.second);
  if (axis.values.empty()) {
    fail_at(*values, fmt::format("axis '{}' has no values; at least 1 is needed", axis.name));
  }
  check_increasing(*values, axis);
  return axis;
}

}  // namespace

std::vector<Axis> read_axes(const toml::table& study, const Model& model) {
  const toml::node* node = study.get("axes");
  if (node == nullptr) {
    throw InputError(
        fmt::format("{}: the study has no axes; give one or two, as in\n"
                    "  [[axes]]\n  name = \"omega\"\n  from = 0.4\n  to = 2.0\n"
                    "  count = 100",
                    place_of(study)));
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
    fail_at(*node, "axes must be tables: [[axes]]");
  }
  if (array->size() > 2) {
    fail_at(*node, fmt::format("{} axes are given; a map has one or two", array->size()));
  }
  std::vector<Axis> axes;
  for (const toml::node& element : *array) {
    axes.push_back(read_axis(*element.as_table(), model));
  }
  if (axes.size() == 2 && axes[0].name == axes[1].name) {
    fail_at(array->back(), fmt::format("axis '{}' is given twice", axes[0].name));
  }
  return axes;
}

}  // namespace gearsweep
