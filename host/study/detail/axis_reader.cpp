#include "study/detail/axis_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/drawing_axis.hpp"
#include "study/detail/point_reader.hpp"
#include "study/detail/swept_name.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxAxes = 2;

double max_values() { return find_key(study_table("axes"), "count")->max; }

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
  const std::optional<std::int64_t> count = whole_value(*count_node);
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

// The values of an axis within its range.
void read_values(const toml::table& table, TableReader* reader, std::pair<double, double> range,
                 Axis* axis) {
  const toml::node* values = reader->find("values");
  if (values == nullptr) {
    read_range(table, reader, range, axis);
    check_increasing(table, *axis);
    return;
  }
  for (const char* key : {"from", "to", "count"}) {
    if (const toml::node* extra = reader->find(key)) {
      fail_at(*extra, fmt::format("axis '{}' has both values and {}", axis->name, key));
    }
  }
  const toml::array* list = values->as_array();
  if (list != nullptr && static_cast<double>(list->size()) > max_values()) {
    fail_at(*values, fmt::format("axis '{}' has {} values; at most {} are possible", axis->name,
                                 list->size(), max_values()));
  }
  axis->values = reader->numbers("values", range.first, range.second);
  if (axis->values.empty()) {
    fail_at(*values, fmt::format("axis '{}' has no values; at least 1 is needed", axis->name));
  }
  check_increasing(*values, *axis);
}

Axis read_axis(const toml::table& table, const Model& model, const toml::table& study) {
  TableReader reader(&table, study_table("axes"));
  Axis axis;
  axis.name = reader.text("name", "");
  if (axis.name.empty()) fail_at(table, "an axis needs a name = \"...\"");
  axis.logarithmic = reader.choice("scale", 0) == 1;
  reader.refuse_unknown();

  const toml::node& name = *reader.find("name");
  const std::optional<SweptKey> swept = find_swept_key(study, model, axis.name);
  if (!swept) {
    const std::pair<double, double> range =
        bind_swept(model, name, "axis", &axis, names_of_keys(study, model));
    read_values(table, &reader, range, &axis);
    return axis;
  }
  if (swept->from.table == nullptr) {
    fail_at(name, fmt::format("axis '{}' is a key of {}, and the study has no such table",
                              axis.name, swept->from.heading));
  }
  bind_key(*swept->key, &axis);
  read_values(table, &reader, {swept->key->min, swept->key->max}, &axis);
  return axis;
}

// The [[axes]], none where there are no such tables.
std::vector<Axis> axes_of_tables(const toml::table& study, const Model& model) {
  std::vector<Axis> axes;
  const toml::node* node = study.get("axes");
  if (node == nullptr) return axes;
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
    fail_at(*node, "axes must be tables: [[axes]]");
  }
  if (array->size() > kMaxAxes) {
    fail_at(*node, fmt::format("{} axes are given; a map has one or two", array->size()));
  }
  for (const toml::node& element : *array) {
    axes.push_back(read_axis(*element.as_table(), model, study));
  }
  return axes;
}

// Two axes must not have a say in one parameter.
void refuse_twice(const std::vector<Axis>& axes, const toml::table& study) {
  std::map<std::string, const Axis*> names;
  for (const Axis& axis : axes) {
    for (const Swept& swept : axis.swept()) {
      const auto [other, is_new] = names.try_emplace(swept.name, &axis);
      if (is_new) continue;
      const toml::node& place =
          axis.is_list ? *study.get("points") : study.get("axes")->as_array()->back();
      if (&axis == other->second && axis.is_list) {
        fail_at(place,
                fmt::format("two columns give {}: it follows from {}", swept.name, swept.follows));
      }
      if (axis.name == other->second->name) {
        fail_at(place, fmt::format("axis '{}' is given twice", axis.name));
      }
      fail_at(place, fmt::format("the axes '{}' and '{}' both give {}", other->second->name,
                                 axis.name, swept.name));
    }
  }
}

}  // namespace

std::vector<Axis> read_axes(const toml::table& study, const PointTable& points,
                            const Model& model) {
  std::vector<Axis> axes = axes_of_tables(study, model);
  if (!points.empty()) {
    const toml::node& place = *study.get("points");
    if (axes.size() == kMaxAxes) {
      fail_at(place, "two axes and a list of points; a list takes the place of one axis");
    }
    axes.push_back(axis_of_points(points, place, study, model));
  }
  return axes;
}

void refuse_idle_axes(const toml::table& study, const Study& read) {
  const toml::array* const tables = study["axes"].as_array();
  for (std::size_t i = 0; tables != nullptr && i < tables->size(); ++i) {
    const Axis& axis = read.axes[i];
    const Model& model = *read.model;
    if (axis.is_state || !axis.columns.empty() || model.uses_parameter(axis.name)) continue;
    fail_at(*(*tables)[i].as_table()->get("name"),
            fmt::format("nothing in model '{}' depends on '{}': the points along this axis would "
                        "all be the same",
                        model.name, axis.name));
  }
}

void take_in_gear(const toml::table& study, const Model& model, std::vector<Axis>* axes) {
  for (std::size_t i = 0; i < axes->size(); ++i) {
    Axis& axis = (*axes)[i];
    if (!axis.others.empty()) {
      add_parameters_of_list(study, *axes, model, *study.get("points"), &axis);
    }
    const std::optional<SweptKey> swept = find_swept_key(study, model, axis.name);
    if (axis.is_list || !swept) continue;
    const GearValues others = first_values(study, model, swept->from, *axes);
    add_parameters(*swept, others, model, (*study["axes"].as_array())[i], &axis);
  }
  refuse_twice(*axes, study);
}

}  // namespace gearsweep
