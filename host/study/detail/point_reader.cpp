#include "study/detail/point_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "study/detail/drawing_axis.hpp"
#include "study/detail/swept_name.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

constexpr const char* kTable = "points";

PointTable points_in_file(const StudyFiles& files, const toml::node& file) {
  const std::string path = files.path_of(file);
  try {
    return read_points(path);
  } catch (const InputError& error) {
    fail_at(file, error.what());
  }
}

PointTable points_of_table(const StudyFiles& files, const PointTable& given,
                           const toml::table& table) {
  TableReader reader(&table, study_table(kTable));
  const toml::node* file = reader.find("file");
  reader.text("file", "");
  const std::vector<std::string> names = reader.texts("names");
  const toml::node* numbers = reader.find("numbers");
  const std::string lines = reader.text("numbers", "");
  reader.number("slope", kUsualSlope);  // for read_spectrum()
  reader.refuse_unknown();
  // A study that was read has none, so it was asked for in place of the numbers.
  if (file != nullptr) return points_in_file(files, *file);
  if (!given.empty()) return given;
  if (numbers != nullptr && names.empty()) {
    fail_at(*numbers, "numbers need names, one for each column");
  }
  if (numbers != nullptr) return parse_points(names, lines, place_of(*numbers) + ": line");
  if (names.empty()) {
    fail_at(table, "[points] needs a file, file = \"points.csv\", or names and numbers");
  }
  fail_at(*reader.find("names"),
          "the numbers of these points are not in the text, but in the result that it is from: "
          "run that, or give a file of points alone, file = \"points.csv\"");
}

// A parameter or a state, a key of [gear], or the share of time; its range.
std::pair<double, double> bind_column(const toml::table& study, const Model& model,
                                      const toml::node& place, Swept* column) {
  std::vector<std::string> keys = names_of_keys(study, model);
  if (std::ranges::find(keys, column->name) != keys.end()) {
    return bind_key(*find_swept_key(study, model, column->name)->key, column);
  }
  const bool is_of_model =
      model.find_parameter(column->name) >= 0 || model.find_state(column->name) >= 0;
  if (column->name == kTimeShare && !is_of_model) {
    constexpr double kLongest = 1e12;  // it may be hours
    column->unit = "1";
    column->meaning = "share of time";
    return {0.0, kLongest};
  }
  if (!keys.empty()) keys.emplace_back(kTimeShare);
  return bind_swept(model, place, "column", column, keys);
}

}  // namespace

PointTable take_in_points(const StudyFiles& files, const PointTable& given, toml::table* study) {
  toml::node* node = study->get(kTable);
  if (node != nullptr && !node->is_table()) fail_at(*node, "points must be a table: [points]");
  if (node == nullptr && given.empty()) return {};
  if (node == nullptr) {
    study->insert(kTable, toml::table());
    node = study->get(kTable);
  }
  toml::table& table = *node->as_table();
  PointTable points = points_of_table(files, given, table);
  toml::array names;
  for (const std::string& name : points.names) names.push_back(name);
  table.erase("file");
  table.insert_or_assign("names", std::move(names));
  table.insert_or_assign("numbers", lines_of(points));
  return points;
}

Axis axis_of_points(const PointTable& points, const toml::node& place, const toml::table& study,
                    const Model& model) {
  Axis axis;
  axis.name = kPointAxis;
  axis.is_list = true;
  axis.meaning = "number of the point";
  for (std::size_t point = 0; point < points.points(); ++point) {
    axis.values.push_back(static_cast<double>(point + 1));
  }
  axis.listed = points.names;
  for (std::size_t i = 0; i < points.names.size(); ++i) {
    Swept column;
    column.name = points.names[i];
    column.values = points.columns[i];
    const auto [min, max] = bind_column(study, model, place, &column);
    for (std::size_t point = 0; point < points.points(); ++point) {
      const double value = column.values[point];
      if (value >= min && value <= max) continue;
      fail_at(place, fmt::format("point {}: {} = {} is out of range; {} .. {} is allowed",
                                 point + 1, column.name, value, min, max));
    }
    const bool is_of_model =
        model.find_parameter(column.name) >= 0 || model.find_state(column.name) >= 0;
    (is_of_model ? axis.columns : axis.others).push_back(std::move(column));
  }
  return axis;
}

toml::table without_numbers(const toml::table& study) {
  toml::table brief = study;
  if (toml::table* table = brief[kTable].as_table()) table->erase("numbers");
  return brief;
}

}  // namespace gearsweep
