// In what two studies differ: what they were given, and what comes of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/detail/assumptions.hpp"
#include "report/detail/highlights.hpp"
#include "report/detail/names.hpp"
#include "report/detail/sections.hpp"
#include "report/detail/speeds.hpp"

namespace gearsweep {
namespace {

using Cells = std::vector<std::string>;

std::string value_of(const std::vector<AssumedValue>& values, const std::string& what) {
  const auto found = std::ranges::find(values, what, &AssumedValue::what);
  return found == values.end() ? "–" : found->value;
}

// What was given: the rows in which the two differ.
std::vector<Cells> differing_inputs(const Sides& sides) {
  const std::vector<AssumedValue> first = assumed_values(sides[0].given);
  const std::vector<AssumedValue> second = assumed_values(sides[1].given);
  std::vector<Cells> rows;
  const auto add = [&](const std::string& what) {
    const std::string before = value_of(first, what), after = value_of(second, what);
    if (before != after) rows.push_back({what, before, after, ""});
  };
  for (const AssumedValue& value : first) add(value.what);
  for (const AssumedValue& value : second) {
    if (std::ranges::find(first, value.what, &AssumedValue::what) == first.end()) add(value.what);
  }
  return rows;
}

// "+12 %", of shares of time "+12 points".
std::string change_html(const ResultMap& map, double before, double after) {
  if (is_share(map)) return fmt::format("{:+.1f} points", 100.0 * (after - before));
  return before == 0.0 ? "" : fmt::format("{:+.1f} %", 100.0 * (after / before - 1.0));
}

std::string largest_html(const ReportFindings& findings, const ResultMap& map, std::size_t point) {
  if (map.values[point] == 0.0) return value_cell(map, point);
  return fmt::format("{} at {}", value_cell(map, point),
                     speed_html(findings, findings.orders.forcing[point]));
}

// The largest value of each quantity over the speed.
std::vector<Cells> differing_results(const Sides& sides) {
  std::vector<Cells> rows;
  for (const std::string& quantity : sides[0].quantities) {
    if (std::ranges::find(sides[1].quantities, quantity) == sides[1].quantities.end()) continue;
    const ResultMap before = sides[0].over_speed("line.nc", quantity);
    const ResultMap after = sides[1].over_speed("line.nc", quantity);
    const std::optional<std::size_t> first = largest_of(before.values);
    const std::optional<std::size_t> second = largest_of(after.values);
    if (!before.flags.empty() || !first || !second) continue;
    rows.push_back({quantity_cell(sides[0], before), largest_html(sides[0], before, *first),
                    largest_html(sides[1], after, *second),
                    change_html(before, before.values[*first], after.values[*second])});
  }
  return rows;
}

// Where the two differ most at one and the same speed, of the load factor, else of the force.
std::string at_one_speed_html(const Sides& sides) {
  const std::string& quantity =
      sides[0].load_factor.empty() ? sides[0].force : sides[0].load_factor;
  if (std::ranges::find(sides[1].quantities, quantity) == sides[1].quantities.end()) return "";
  const ResultMap before = sides[0].over_speed("line.nc", quantity);
  const ResultMap after = sides[1].over_speed("line.nc", quantity);
  if (before.axes.front().values != after.axes.front().values) {
    return "The two have other speeds, so no speed is compared with itself.";
  }
  std::vector<double> rise;
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    rise.push_back(after.values[i] - before.values[i]);
  }
  const std::optional<std::size_t> most = largest_of(rise);
  if (!most) return "";
  return fmt::format("At one and the same speed {} rises most at {}: from {} to {}.",
                     quantity_cell(sides[0], before),
                     speed_html(sides[0], sides[0].orders.forcing[*most]),
                     value_cell(before, *most), value_cell(after, *most));
}

}  // namespace

void add_differences(const Sides& sides, HtmlPage* page) {
  if (sides.size() < 2) return;
  page->heading("What differs");
  const std::string first = html_text(sides[0].name), second = html_text(sides[1].name);
  HtmlTable table;
  table.head = {"given", first, second, ""};
  table.rows = differing_inputs(sides);
  if (table.rows.empty()) {
    page->paragraph("The two studies were given the same numbers.");
  } else {
    page->table(table);
  }
  table.head = {"largest over the speed", first, second, "change"};
  table.rows = differing_results(sides);
  page->table(table);
  const std::string rise = at_one_speed_html(sides);
  if (!rise.empty()) page->paragraph(rise);
}

}  // namespace gearsweep
