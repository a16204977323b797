#include "study/detail/gear_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "model/error.hpp"
#include "study/detail/number_lines.hpp"
#include "study/table_file.hpp"

namespace gearsweep {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
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
  if (key.type == kFile) return table_text(read_table(path, key.units));
  if (key.type == kFileOverPath) {
    return table_text(
        parse_over_path(number_file_text(path, kMaxTeethBytes, kTeethFile), path, key.units));
  }
  return text_of_teeth(
      parse_teeth(number_file_text(path, kMaxTeethBytes, kTeethFile), path, key.units));
}

std::string text_in_tables(GearReader& in, const GearKey& key, const std::string& name) {
  const toml::table* tables = in.tables();
  const toml::node* node = tables == nullptr ? nullptr : tables->get(name);
  if (node == nullptr || !node->is_string()) {
    fail_at(in.node(key), fmt::format("'{}' is not in [gear.tables] of the study", name));
  }
  return node->as_string()->get();
}

std::string place_in_tables(const std::string& name) {
  return fmt::format("'{}' in [gear.tables]", name);
}

// Gauss's three points between neighbours: right for a cubic.
double mean_of(const PeriodicTable& table, const std::vector<TablePoint>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double from = points[i].phase;
    const double to =
        i + 1 < points.size() ? points[i + 1].phase : points.front().phase + kWholeTurn;
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    if (half == 0.0) continue;
    const double reach = half * std::sqrt(0.6);
    sum += half / 9.0 *
           (5.0 * table.at(middle - reach, middle) + 8.0 * table.at(middle, middle) +
            5.0 * table.at(middle + reach, middle));
  }
  return sum / kWholeTurn;
}

}  // namespace

void take_in_gear_files(const StudyFiles& files, toml::table* root) {
  toml::table* gear = (*root)["gear"].as_table();
  if (gear == nullptr) return;
  if (const toml::node* node = gear->get(kTables); node != nullptr && !node->is_table()) {
    fail_at(*node, "tables must be a table: [gear.tables]");
  }
  toml::table tables;
  const toml::table* held = (*gear)[kTables].as_table();
  for (const GearKey& key : kGearKeys) {
    if (!key.is_file()) continue;
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

std::optional<MeasuredCurve> measured_curve(GearReader& in, const GearKey& key,
                                            Interpolation interpolation) {
  const std::optional<std::string> name = in.text(key);
  if (!name) return std::nullopt;
  const std::string text = text_in_tables(in, key, *name);
  try {
    const std::vector<TablePoint> points = parse_table(text, place_in_tables(*name), key.units);
    MeasuredCurve curve{std::make_shared<const PeriodicTable>(*name, points, interpolation), 0.0};
    curve.mean = mean_of(*curve.table, points);
    return curve;
  } catch (const InputError& error) {
    fail_at(in.node(key), error.what());
  }
}

std::optional<std::vector<double>> errors_of_teeth(GearReader& in, const GearKey& key,
                                                   double teeth) {
  const std::optional<std::string> name = in.text(key);
  if (!name) return std::nullopt;
  const std::string text = text_in_tables(in, key, *name);
  std::vector<double> errors;
  try {
    errors = parse_teeth(text, place_in_tables(*name), key.units);
  } catch (const InputError& error) {
    fail_at(in.node(key), error.what());
  }
  if (static_cast<double>(errors.size()) != teeth) {
    fail_at(in.node(key), fmt::format("'{}' has {} numbers; it needs one for each of the {} teeth",
                                      *name, errors.size(), teeth));
  }
  return errors;
}

std::optional<std::vector<TablePoint>> curve_over_path(GearReader& in, const GearKey& key) {
  const std::optional<std::string> name = in.text(key);
  if (!name) return std::nullopt;
  const std::string text = text_in_tables(in, key, *name);
  try {
    return parse_over_path(text, place_in_tables(*name), key.units);
  } catch (const InputError& error) {
    fail_at(in.node(key), error.what());
  }
}

double value_over_path(const std::vector<TablePoint>& points, double place) {
  const auto after = std::ranges::upper_bound(points, place, {}, &TablePoint::phase);
  if (after == points.begin()) return points.front().value;
  if (after == points.end()) return points.back().value;
  const TablePoint &left = *(after - 1), &right = *after;
  return left.value +
         (right.value - left.value) * (place - left.phase) / (right.phase - left.phase);
}

std::vector<Harmonic> harmonics_of(const std::function<double(double)>& value, std::size_t count) {
  constexpr std::size_t kSamples = 4096;
  std::vector<Harmonic> harmonics;
  for (std::size_t order = 1; order <= count; ++order) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double angle = kWholeTurn * static_cast<double>(i) / kSamples;
      sum += value(angle) * std::polar(1.0, -angle * static_cast<double>(order));
    }
    // |c| cos(n x + arg c) = |c| sin(n x + arg c + pi/2)
    harmonics.push_back({2.0 / kSamples * std::abs(sum), std::arg(sum) + 0.5 * std::numbers::pi});
  }
  return harmonics;
}

}  // namespace gearsweep
