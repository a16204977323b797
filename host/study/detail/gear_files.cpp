#include "study/detail/gear_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/error.hpp"
#include "study/detail/heading_unit.hpp"
#include "study/detail/number_lines.hpp"
#include "study/detail/toml_access.hpp"
#include "study/table_file.hpp"

namespace gearsweep {
namespace {

constexpr const char* kTables = "tables";
constexpr const char* kTeethFile = "a list of errors";
constexpr std::size_t kMaxTeethBytes = 1U << 16U;

// One number to the line; a first line that has none is a heading.
std::vector<double> parse_teeth(std::string_view text, const std::string& source,
                                std::span<const ValueUnit> units) {
  NumberLines lines(text, kMaxTeethBytes, kTeethFile, source);
  std::vector<double> errors;
  std::vector<std::string_view> fields;
  double scale = 1.0;
  for (bool is_first = true; lines.next(&fields); is_first = false) {
    const std::optional<double> number = number_in(fields.front());
    if (!number && is_first) {
      scale = scale_in_heading(units, fields, lines);
      continue;
    }
    if (!number || !std::isfinite(*number) || fields.size() != 1) {
      lines.fail("a line has one number, the error of a tooth in um: 2.5");
    }
    errors.push_back(*number * scale);
  }
  return errors;
}

std::string text_of_teeth(const std::vector<double>& errors) {
  std::string text;
  for (const double error : errors) text += fmt::format("{}\n", error);
  return text;
}

// Two numbers to the line: a place on the path of contact, and the value there.
std::vector<TablePoint> parse_over_path(std::string_view text, const std::string& source,
                                        std::span<const ValueUnit> units) {
  NumberLines lines(text, kMaxTeethBytes, kTeethFile, source);
  std::vector<TablePoint> points;
  std::vector<std::string_view> fields;
  double scale = 1.0;
  for (bool is_first = true; lines.next(&fields); is_first = false) {
    const std::optional<double> place = number_in(fields.front());
    if (!place && is_first) {
      scale = scale_in_heading(units, std::span(fields).subspan(1), lines);
      continue;
    }
    const std::optional<double> value = fields.size() == 2 ? number_in(fields[1]) : std::nullopt;
    if (!place || !value || !std::isfinite(*value) || !(*place >= 0.0 && *place <= 1.0)) {
      lines.fail(
          "a line has two numbers: the share of the path of contact, 0 to 1, and the value there");
    }
    if (!points.empty() && !(*place > points.back().phase)) lines.fail("shares must rise");
    points.push_back({*place, *value * scale});
  }
  if (points.empty()) lines.fail("there are no points");
  return points;
}

// As it stands in [gear.tables].
std::string read_file(const std::string& path, const GearKey& key) {
  if (key.form == KeyForm::mesh_curve) return table_text(read_table(path, key.units));
  const std::string text = number_file_text(path, kMaxTeethBytes, kTeethFile);
  if (key.form == KeyForm::path_curve) return table_text(parse_over_path(text, path, key.units));
  return text_of_teeth(parse_teeth(text, path, key.units));
}

// Puts the numbers of files into a drawing's table.
void take_in_files(const StudyFiles& files, toml::table* gear) {
  if (const toml::node* node = gear->get(kTables); node != nullptr && !node->is_table()) {
    fail_at(*node, "tables must be a table: [gear.tables]");
  }
  toml::table tables;
  const toml::table* held = (*gear)[kTables].as_table();
  for (const GearKey& key : kGearKeys) {
    if (!key.is_measured()) continue;
    const toml::node* node = gear->get(key.name);
    if (node == nullptr) continue;
    if (!node->is_string()) {
      fail_at(*node, fmt::format("{} must be the name of a file in quotes", key.name));
    }
    const std::string& name = node->as_string()->get();
    const toml::node* text = held == nullptr ? nullptr : held->get(name);
    if (text != nullptr && text->is_string()) {
      tables.insert_or_assign(name, text->as_string()->get());
      continue;
    }
    const std::string path = files.path_of(*node);
    try {
      tables.insert_or_assign(name, read_file(path, key));
    } catch (const InputError& error) {
      fail_at(*node, error.what());
    }
  }
  gear->erase(kTables);
  if (!tables.empty()) gear->insert(kTables, std::move(tables));
}

}  // namespace

void take_in_gear_files(const StudyFiles& files, toml::table* root) {
  toml::table* gear = (*root)["gear"].as_table();
  if (gear == nullptr) return;
  for (auto&& [key, node] : *gear) {
    if (node.is_table() && key.str() != kTables) take_in_files(files, node.as_table());
  }
  take_in_files(files, gear);
}

Measured read_measured(const toml::table& gear, const GearKey& key) {
  const toml::node& node = *gear.get(key.name);
  Measured measured;
  measured.source = node.value_or(std::string());
  const toml::node* held = gear[kTables][measured.source].node();
  if (held == nullptr || !held->is_string()) {
    fail_at(node, fmt::format("'{}' is not in [gear.tables] of the study", measured.source));
  }
  const std::string& text = held->as_string()->get();
  const std::string source = fmt::format("'{}' in [gear.tables]", measured.source);
  try {
    if (key.form == KeyForm::tooth_list) {
      measured.teeth = parse_teeth(text, source, key.units);
    } else if (key.form == KeyForm::path_curve) {
      measured.points = parse_over_path(text, source, key.units);
    } else {
      measured.points = parse_table(text, source, key.units);
    }
  } catch (const InputError& error) {
    fail_at(node, error.what());
  }
  return measured;
}

}  // namespace gearsweep
