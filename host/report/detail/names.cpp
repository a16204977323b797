#include "report/detail/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/detail/html.hpp"
#include "report/detail/words.hpp"

namespace gearsweep {

namespace {

std::string unit_html(const ResultMap& map) {
  const std::string unit = html_unit(map.unit);
  return unit.empty() ? "" : fmt::format(" ({})", unit);
}

// "dmf_s1_max to dmf_s3_max"
std::string raw_name(const ReportFindings& findings, const std::string& quantity) {
  const int count = findings.count_of(quantity);
  std::optional<NumberedQuantity> last = numbered(quantity);
  if (count < 2 || !last) return quantity;
  last->number = count;
  return fmt::format("{} to {}{}", quantity, last->stem(), last->after);
}

}  // namespace

std::string quantity_cell(const Model& model, const ResultMap& map) {
  return html_named(words_html(model, map.name) + unit_html(map), map.name);
}

std::string quantity_cell(const ReportFindings& findings, const ResultMap& map) {
  return html_named(
      words_html(*findings.study.model, map.name, findings.count_of(map.name)) + unit_html(map),
      raw_name(findings, map.name));
}

std::string named_html(const ReportFindings& findings, const std::string& quantity) {
  return html_named(words_html(*findings.study.model, quantity, findings.count_of(quantity)),
                    raw_name(findings, quantity));
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
