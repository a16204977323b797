#include "report/detail/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "model/names.hpp"
#include "plan/plan.hpp"
#include "report/detail/speeds.hpp"
#include "result/peaks.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

using Row = std::vector<std::string>;

// "mesh_stiffness_N_per_m" as words and a unit: {"mesh stiffness", "N/m"}.
std::pair<std::string, std::string> words_and_unit(const std::string& key) {
  static const std::vector<std::pair<std::string, std::string>> kUnits = {{"_N_s_per_mm", "N s/mm"},
                                                                          {"_N_per_mm", "N/mm"},
                                                                          {"_N_per_m", "N/m"},
                                                                          {"_kg_mm2", "kg mm²"},
                                                                          {"_N_m", "N m"},
                                                                          {"_kg", "kg"},
                                                                          {"_mm", "mm"},
                                                                          {"_um", "µm"},
                                                                          {"_deg", "°"},
                                                                          {"_rpm", "rpm"},
                                                                          {"_N", "N"}};
  std::string words = key, unit;
  for (const auto& [ending, name] : kUnits) {
    if (!key.ends_with(ending)) continue;
    words = key.substr(0, key.size() - ending.size());
    unit = name;
    break;
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  return {words, unit};
}

// "[ 40, 40 ]" as "40, 40", "217400000.0" as "2.174e+08".
std::string printed_value(std::string value) {
  std::erase_if(value, [](char letter) { return letter == '[' || letter == ']'; });
  std::vector<std::string> parts;
  for (const std::string& part : split(value, ',')) {
    const std::string word = split_words(part).empty() ? "" : split_words(part).front();
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    const bool is_number = !word.empty() && *end == '\0';
    parts.push_back(is_number ? fmt::format("{:.6g}", number) : part);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// The lines "key = value" of the table [gear] in the study's text, or of [gear.NAME], whose name
// stands before the words.
std::vector<Row> gear_rows(const Study& study) {
  std::map<std::string, std::string> headings = {{"[gear]", ""}};
  for (const std::string& name : study.model->drawings) {
    headings[fmt::format("[gear.{}]", name)] = name + ": ";
  }
  std::vector<Row> rows;
  auto heading = headings.end();
  for (const std::string& line : split(study.toml, '\n')) {
    if (line.starts_with('[')) heading = headings.find(line);
    const std::size_t equals = line.find(" = ");
    if (heading == headings.end() || equals == std::string::npos) continue;
    const auto [words, unit] = words_and_unit(line.substr(0, equals));
    rows.push_back({html_text(heading->second + words),
                    html_text(printed_value(line.substr(equals + 3))), html_text(unit)});
  }
  return rows;
}

std::vector<Row> parameter_rows(const Study& study) {
  std::vector<Row> rows;
  const Model& model = *study.model;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    const std::string origin = i < study.parameter_origins.size() ? study.parameter_origins[i] : "";
    const bool is_swept = study.find_on_axes(i) != nullptr;
    const DerivedParameter* const derived = study.differs(i) ? model.find_derived(i) : nullptr;
    rows.push_back({html_text(info.name),
                    is_swept             ? "swept"
                    : derived != nullptr ? html_text("= " + derived->expression)
                                         : fmt::format("{:.6g}", study.setting.parameters[i]),
                    html_unit(info.unit), html_text(info.meaning), html_text(origin)});
  }
  return rows;
}

std::string axis_text(const Axis& axis, const Scales& scales) {
  const double from = axis.values.front(), to = axis.values.back();
  const std::string unit = html_unit(axis.unit);
  const SiUnit si = shown_unit(axis.unit, scales);
  std::string text = fmt::format("{} from {:g} to {:g}{}", html_text(axis.name), from, to,
                                 unit.empty() ? "" : " " + unit);
  if (si.scale > 0.0) {
    text += fmt::format(" ({} to {} {})", html_number(si.scale * from), html_number(si.scale * to),
                        html_text(si.name));
  }
  return text + fmt::format(", {} values", axis.values.size());
}

// Where the report's curves are: " (mu = 0.05)"; empty without another axis.
std::string place_html(const ReportFindings& findings) {
  if (!findings.at) return "";
  return fmt::format(" ({} = {:.4g})", html_text(findings.at->first), findings.at->second);
}

std::string quantity_html(const ResultMap& map) {
  const std::string unit = html_unit(map.unit);
  return html_text(map.name) + (unit.empty() ? "" : fmt::format(" ({})", unit));
}

std::string value_html(const ResultMap& map, std::size_t point) {
  const double value = map.values[point];
  if (!std::isfinite(value)) return "–";
  if (map.flags.empty()) return html_number(value);
  const auto flag = static_cast<std::size_t>(value);
  std::string name = flag < map.flags.size() ? map.flags[flag] : "";
  std::replace(name.begin(), name.end(), '_', ' ');
  return html_text(name);
}

// The largest force of the sweep by the static one, and what the standard expects of it.
void add_dynamic_factor(const ReportFindings& findings, HtmlPage* page) {
  page->picture(
      findings.drawn("factor", {"line.nc", "factor.nc"}, ReportFindings::kLoadFactor, true,
                     {"largest mesh force / static force", "K_v, ISO 6336-1 method B"}),
      caption_of("Dynamic load factor, and the dynamic factor K_v of ISO 6336-1:2006 by "
                 "method B, over the speed",
                 findings));
  page->paragraph(
      "K<sub>v</sub> follows from the deviations of pitch and profile, not from the transmission "
      "error and the faults that the sweep has; it is for steel with case-hardened or nitrided "
      "flanks (running-in takes 7.5 % of a deviation, at most 3 µm) and an application factor of "
      "1. Its resonance is where the mesh frequency is &#8730;(k<sub>0</sub>/m<sub>e</sub>), of "
      "rigid shafts.");
}

// What the largest force is at any speed; empty where the force does not jump.
std::string jump_html(const ReportFindings& findings) {
  constexpr double kLeast = 1.01;
  const Study& line = findings.line;
  const double jump = static_jump(*line.model, Plan(line, line.points()).setting_of(0));
  if (jump < kLeast) return "";
  return fmt::format(
      "The largest force is at least about {:.3g} times the mean load at any speed, also without "
      "any "
      "error: where a pair of teeth enters, the stiffness of the model jumps by this factor at "
      "once, "
      "and the deflection cannot. Teeth of a gear take up their load gradually. So a largest force "
      "near that is no resonance, and the speeds are ranked by the vibration of the force, its "
      "standard deviation, to which the jump adds little.",
      jump);
}

// A jump of a run between neighbouring speeds.
struct Jump {
  std::string run;
  const ResultMap* map = nullptr;
  std::size_t from = 0, to = 0;  // points

  double size() const { return std::abs(map->values[to] - map->values[from]); }
};

}  // namespace

std::string caption_of(const std::string& what, const ReportFindings& findings) {
  return what + place_html(findings) + ".";
}

void add_data(const ReportFindings& findings, HtmlPage* page) {
  const Study& study = findings.study;
  page->heading("Data");
  page->paragraph(
      fmt::format("{}: {}", html_text(study.model->name), html_text(study.model->summary)));
  const std::vector<Row> gear = gear_rows(study);
  if (!gear.empty()) page->table({"gear pair", "value", "unit"}, gear);
  if (!study.gear_notes.empty()) {
    page->paragraph("What follows from it:");
    std::vector<std::string> notes;
    for (const std::string& note : study.gear_notes) notes.push_back(html_text(note));
    const Scales& scales = study.scales;
    if (scales.known()) {
      notes.push_back(
          fmt::format("one unit of force, k<sub>0</sub> b<sub>n</sub>, is {:.5g} N; one of length, "
                      "b<sub>n</sub>, is {:.5g} µm; one of frequency, ϖ, is {:.5g} rad/s",
                      scales.k0 * scales.b_n, 1e6 * scales.b_n, scales.varpi));
    }
    page->list(notes);
  }
  std::vector<std::string> axes;
  for (const Axis& axis : study.axes) axes.push_back(axis_text(axis, study.scales));
  page->paragraph(fmt::format("Swept: {}.", fmt::join(axes, "; ")));
  page->begin_details("All parameters of the model, and where each comes from");
  page->table({"parameter", "value", "unit", "meaning", "from"}, parameter_rows(findings.given));
  page->end_details();
}

void add_natural_frequencies(const ReportFindings& findings, HtmlPage* page) {
  page->heading("Natural frequencies and critical speeds");
  const std::vector<ReportMode> modes = distinct_modes(findings);
  if (modes.empty()) {
    page->paragraph("Small motions about the static equilibrium do not oscillate.");
    return;
  }
  page->paragraph(
      "Of small motions about the static equilibrium, teeth in contact, with the mean stiffness. "
      "At a critical speed an order of the mesh frequency meets a natural frequency; <b>bold</b>: "
      "within the speeds of this report. Where teeth lose contact, resonance bends to lower "
      "speeds.");
  const auto [slowest, fastest] =
      std::minmax_element(findings.orders.forcing.begin(), findings.orders.forcing.end());
  Row head = {"natural frequency", "modes", "damping"};
  for (const ExcitationOrder& order : excitation_orders()) head.push_back("order " + order.name);
  std::vector<Row> rows;
  for (const ReportMode& mode : modes) {
    Row row = {frequency_html(findings, mode.frequency), fmt::format("{}", mode.count),
               fmt::format("{:.2g} %", 100.0 * mode.damping)};
    for (const ExcitationOrder& order : excitation_orders()) {
      const double forcing = mode.frequency / order.order;
      const bool is_swept = forcing >= *slowest && forcing <= *fastest;
      const std::string speed = speed_html(findings, forcing);
      row.push_back(is_swept ? fmt::format("<b>{}</b>", speed) : speed);
    }
    rows.push_back(std::move(row));
  }
  page->table(head, rows);
}

void add_forces(const ReportFindings& findings, HtmlPage* page) {
  page->heading("Force and contact over speed");
  std::vector<std::string> stacked = findings.quantities;
  const bool has_factor = !findings.dynamic_factors.empty();
  const std::string& drawing = findings.study.model->unit_drawing;
  if (has_factor) std::erase(stacked, ReportFindings::kLoadFactor);
  page->picture(
      findings.drawn("line", {"line.nc"}, fmt::format("{}", fmt::join(stacked, ",")), true),
      caption_of("Largest force, contact and vibration over the speed", findings));
  if (has_factor) {
    add_dynamic_factor(findings, page);
  } else if (findings.is_si()) {
    page->paragraph(fmt::format(
        "With <code>pitch_deviation_um</code>, <code>profile_form_deviation_um</code> "
        "and <code>face_width_mm</code> in [gear{}] the dynamic factor K<sub>v</sub> of "
        "ISO 6336-1 stands beside the dynamic load factor.",
        drawing.empty() ? "" : "." + html_text(drawing)));
  }
  if (!findings.at) return;
  for (const std::string& quantity : findings.quantities) {
    const bool is_map = quantity == findings.force || quantity == "contact_class" ||
                        quantity == "dynamic_load_factor";
    if (!is_map) continue;
    page->picture(findings.drawn("map-" + quantity, {"map.nc"}, quantity, false),
                  fmt::format("{}: {}.", html_text(quantity),
                              html_text(findings.over_speed("line.nc", quantity).meaning)));
  }
}

void add_worst_speeds(const ReportFindings& findings, HtmlPage* page) {
  page->heading("Worst speeds");
  const ResultMap force = findings.over_speed("line.nc", findings.force);
  PeakSearch search;
  search.count = 6;
  const std::vector<Peak> peaks =
      find_peaks(findings.over_speed("line.nc", findings.vibration), search);
  std::vector<ResultMap> others;
  for (const std::string& quantity : findings.quantities) {
    if (quantity != findings.force) others.push_back(findings.over_speed("line.nc", quantity));
  }
  Row head = {"speed", quantity_html(force)};
  for (const ResultMap& other : others) head.push_back(quantity_html(other));
  const bool has_factor = !findings.dynamic_factors.empty();
  if (has_factor) head.emplace_back("K<sub>v</sub>, ISO 6336-1 method B");
  head.emplace_back("near");
  std::vector<Row> rows;
  for (const Peak& peak : peaks) {
    const double forcing = findings.orders.forcing[peak.point];
    Row row = {speed_html(findings, forcing) + (peak.at_edge ? " (end of the sweep)" : ""),
               value_html(force, peak.point)};
    for (const ResultMap& other : others) row.push_back(value_html(other, peak.point));
    if (has_factor) row.push_back(html_number(findings.dynamic_factors[peak.point]));
    row.push_back(resonance_html(findings, forcing));
    rows.push_back(std::move(row));
  }
  page->paragraph(fmt::format("Peaks of {} over the speed{}, the largest first.",
                              html_text(findings.vibration), place_html(findings)));
  const std::string jump = jump_html(findings);
  if (!jump.empty()) page->paragraph(jump);
  page->table(head, rows);
}

void add_order_map(const ReportFindings& findings, HtmlPage* page) {
  page->heading("Order map");
  page->picture(
      findings.drawn("orders", {"orders.nc"}, "", false),
      caption_of(fmt::format("Amplitudes of {} at each speed. White: natural frequencies; "
                             "dotted: orders of the mesh frequency",
                             html_text(findings.orders.channel.name)),
                 findings));
}

void add_directions(const ReportFindings& findings, HtmlPage* page) {
  page->heading("Run-up and run-down");
  if (!findings.has_directions) {
    page->paragraph("Not computed: " + html_text(findings.no_directions));
    return;
  }
  page->picture(findings.drawn("directions", {"up.nc", "down.nc"}, findings.force, true),
                caption_of("Each speed goes on from the motion at the one before it. Where the "
                           "curves part, two motions exist",
                           findings));
  const ResultMap up = findings.over_speed("up.nc", findings.force);
  const ResultMap down = findings.over_speed("down.nc", findings.force);
  std::vector<Jump> jumps;
  for (const Hysteresis& part : find_hysteresis(up, down)) {
    if (part.jumps_up) jumps.push_back({"run-up", &up, part.last, part.last + 1});
    if (part.jumps_down) jumps.push_back({"run-down", &down, part.first, part.first - 1});
  }
  if (jumps.empty()) {
    page->paragraph("No jump was found.");
    return;
  }
  std::sort(jumps.begin(), jumps.end(),
            [](const Jump& a, const Jump& b) { return a.size() > b.size(); });
  constexpr std::size_t kMost = 10;
  std::vector<Row> rows;
  for (const Jump& jump : jumps) {
    if (rows.size() == kMost) break;
    rows.push_back(
        {jump.run,
         fmt::format("{} to {}", speed_html(findings, findings.orders.forcing[jump.from]),
                     speed_html(findings, findings.orders.forcing[jump.to])),
         value_html(*jump.map, jump.from), value_html(*jump.map, jump.to)});
  }
  page->table({"jump in", "between", quantity_html(up) + " before", "after"}, rows);
  if (jumps.size() > kMost) {
    page->paragraph(fmt::format(
        "These are the largest of {}. Where the motion is chaotic, the two runs differ by chance.",
        jumps.size()));
  }
}

}  // namespace gearsweep
