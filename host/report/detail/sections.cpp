// The tables of a report: worst speeds, natural frequencies.
#include "report/detail/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/detail/equal_parts.hpp"
#include "report/detail/names.hpp"
#include "report/detail/speeds.hpp"
#include "result/peaks.hpp"

namespace gearsweep {
namespace {

using Row = std::vector<std::string>;

// What the largest force is at any speed; empty where the force does not jump.
std::string jump_html(const ReportFindings& findings) {
  constexpr double kLeast = 1.01;
  if (findings.jump < kLeast) return "";
  return fmt::format(
      "A largest force of about {:.3g} times the mean load is there at any speed: the force of the "
      "model jumps by this factor where a pair of teeth enters, or where friction turns round at "
      "the pitch point. On a gear neither is sudden.{}",
      findings.jump,
      findings.ranking == findings.force ? ""
                                         : " The largest force is hardly more at these speeds, so "
                                           "they are ranked by its vibration "
                                           "(standard deviation), to which the jump adds little.");
}

// Speeds beside each other, so that what is known of them fits a page.
HtmlTable worst_speeds_of(const ReportFindings& findings) {
  PeakSearch search;
  search.count = 5;
  const std::vector<Peak> peaks =
      find_peaks(findings.over_speed("line.nc", findings.ranking), search);
  const auto row_of = [&](const std::string& what, const auto& cell) {
    Row row = {what};
    for (const Peak& peak : peaks) row.push_back(cell(peak.point));
    return row;
  };
  const auto forcing = [&](std::size_t point) { return findings.orders.forcing[point]; };
  HtmlTable table;
  table.is_numbers = table.is_even = true;
  table.head = row_of("", [&](std::size_t point) { return speed_html(findings, forcing(point)); });
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (peaks[i].at_edge) table.head[i + 1] += " (end)";
  }
  for (const std::string& quantity : findings.quantities) {
    const ResultMap map = findings.over_speed("line.nc", quantity);
    table.rows.push_back(row_of(quantity_cell(findings, map),
                                [&](std::size_t point) { return value_cell(map, point); }));
  }
  if (!findings.dynamic_factors.empty()) {
    table.rows.push_back(row_of("K<sub>v</sub>, ISO 6336-1 method B", [&](std::size_t point) {
      return html_number(findings.dynamic_factors[point]);
    }));
  }
  table.rows.push_back(
      row_of("near", [&](std::size_t point) { return resonance_html(findings, forcing(point)); }));
  return table;
}

// Two digits: "0.48 %", "100 %".
std::string damping_html(double damping) {
  const double percent = 100.0 * damping;
  constexpr double kLong = 99.5;  // of two digits
  return percent < kLong ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

HtmlTable critical_speeds_of(const ReportFindings& findings) {
  const auto [slowest, fastest] =
      std::minmax_element(findings.orders.forcing.begin(), findings.orders.forcing.end());
  HtmlTable table;
  table.is_numbers = true;
  table.head = {"natural frequency", "modes", "damping"};
  for (const ExcitationOrder& order : excitation_orders(findings)) {
    table.head.push_back("order " + html_text(order.name));
  }
  for (const ReportMode& mode : distinct_modes(findings)) {
    Row row = {frequency_html(findings, mode.frequency), fmt::format("{}", mode.count),
               damping_html(mode.damping)};
    for (const ExcitationOrder& order : excitation_orders(findings)) {
      const double forcing = mode.frequency / order.order;
      const bool is_swept = forcing >= *slowest && forcing <= *fastest;
      const std::string speed = speed_html(findings, forcing);
      row.push_back(is_swept ? fmt::format("<b>{}</b>", speed) : speed);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Below which the tables of one of several studies stand.
void add_name(const Sides& sides, const ReportFindings& findings, HtmlPage* page) {
  if (sides.size() > 1) page->subheading(html_text(findings.name));
}

}  // namespace

void add_worst_speeds(const Sides& sides, HtmlPage* page) {
  page->heading("Worst speeds");
  for (const ReportFindings& findings : sides) {
    add_name(sides, findings, page);
    page->paragraph(fmt::format("Peaks of the {} over the speed, the largest first{}.",
                                named_html(findings, findings.ranking), place_html(findings)));
    page->table(worst_speeds_of(findings));
    const std::string jump = jump_html(findings);
    if (!jump.empty()) page->small(jump);
    const std::string unlike = equal_parts_html(findings);
    if (!unlike.empty()) page->small(unlike);
  }
}

void add_natural_frequencies(const Sides& sides, HtmlPage* page) {
  page->heading("Natural frequencies and critical speeds");
  page->paragraph(
      "Of small motions with teeth in contact and the mean stiffness. At a critical speed an order "
      "of the mesh frequency meets a natural frequency; <b>bold</b>: within the speeds of this "
      "report. Where teeth lose contact, resonance bends to lower speeds.");
  std::vector<Row> before;
  for (const ReportFindings& findings : sides) {
    const HtmlTable table = critical_speeds_of(findings);
    if (&findings != &sides.front() && table.rows == before) {
      page->paragraph(fmt::format("Those of {} are the same.", html_text(findings.name)));
      continue;
    }
    add_name(sides, findings, page);
    if (table.rows.empty()) {
      page->paragraph("Small motions about the static equilibrium do not oscillate.");
    } else {
      page->table(table);
    }
    before = table.rows;
  }
}

}  // namespace gearsweep
