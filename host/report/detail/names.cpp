#include "report/detail/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/labels.hpp"
#include "report/detail/html.hpp"

namespace gearsweep {

std::string quantity_cell(const ResultMap& map) {
  const std::string unit = html_unit(map.unit);
  return html_named(quantity_html(map.name) + (unit.empty() ? "" : fmt::format(" ({})", unit)),
                    map.name);
}

bool is_share(const ResultMap& map) {
  return map.name.ends_with("contact_gap") || map.name.ends_with("_share");
}

std::string value_cell(const ResultMap& map, std::size_t point) {
  const double value = map.values[point];
  if (!std::isfinite(value)) return "–";
  if (is_share(map)) return html_percent(value);
  if (map.flags.empty()) return html_number(value);
  const auto flag = static_cast<std::size_t>(value);
  std::string name = flag < map.flags.size() ? map.flags[flag] : "";
  std::replace(name.begin(), name.end(), '_', ' ');
  return html_text(name);
}

std::string place_html(const ReportFindings& findings) {
  if (!findings.at) return "";
  return fmt::format(" ({} = {:.4g})", html_text(findings.at->first), findings.at->second);
}

std::string caption_of(const std::string& what, const ReportFindings& findings) {
  return what + place_html(findings) + ".";
}

}  // namespace gearsweep
