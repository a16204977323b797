// The sections of a report that show pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/labels.hpp"
#include "report/detail/figures.hpp"
#include "report/detail/highlights.hpp"
#include "report/detail/names.hpp"
#include "report/detail/sections.hpp"
#include "report/detail/speeds.hpp"
#include "report/detail/words.hpp"

namespace gearsweep {
namespace {

bool all_have(const Sides& sides, const std::string& quantity) {
  return std::ranges::all_of(sides, [&](const ReportFindings& findings) {
    return std::ranges::find(findings.quantities, quantity) != findings.quantities.end();
  });
}

bool all_have_factors(const Sides& sides) {
  return std::ranges::none_of(
      sides, [](const ReportFindings& findings) { return findings.dynamic_factors.empty(); });
}

// Whether a share of time without contact is 0 at all speeds, of which the page says so in words.
bool is_never_apart(const Sides& sides, const std::string& quantity) {
  return std::ranges::all_of(sides, [&](const ReportFindings& findings) {
    const bool is_apart = std::ranges::find(findings.apart, quantity) != findings.apart.end();
    return is_apart && std::ranges::none_of(findings.over_speed("line.nc", quantity).values,
                                            [](double share) { return share > 0.0; });
  });
}

// "Largest meshing force".
std::string caption_for(const ReportFindings& findings, const std::string& quantity) {
  std::string words = words_html(*findings.study.model, quantity, findings.count_of(quantity));
  if (!words.empty())
    words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + " over the speed";
}

// The signal whose order map is shown.
std::string order_signal_html(const ReportFindings& findings) {
  const ChannelInfo& signal = findings.orders.channel;
  const std::optional<std::string> words = signal_words(signal);
  return words ? html_text(*words) : quantity_html(signal.name);
}

void append(std::vector<HtmlFigure> more, std::vector<HtmlFigure>* figures) {
  std::ranges::move(more, std::back_inserter(*figures));
}

void add_dynamic_factor_note(const ReportFindings& findings, HtmlPage* page) {
  if (!findings.dynamic_factors.empty()) {
    page->small(
        "K<sub>v</sub> follows from the deviations of pitch and profile, not from the transmission "
        "error and the faults that the sweep has; it is for steel with case-hardened or nitrided "
        "flanks (running-in takes 7.5 % of a deviation, at most 3 µm) and an application factor of "
        "1. Its resonance is where the mesh frequency is &#8730;(k<sub>0</sub>/m<sub>e</sub>), of "
        "rigid shafts.");
  } else if (findings.is_si()) {
    const std::string& drawing = findings.study.model->unit_drawing;
    page->small(fmt::format(
        "With <code>pitch_deviation_um</code>, <code>profile_form_deviation_um</code> "
        "and <code>face_width_mm</code> in [gear{}] the dynamic factor K<sub>v</sub> of "
        "ISO 6336-1 stands beside the dynamic load factor.",
        drawing.empty() ? "" : "." + html_text(drawing)));
  }
}

std::vector<HtmlFigure> curves(const Sides& sides) {
  std::vector<HtmlFigure> figures;
  const ReportFindings& first = sides.front();
  for (const std::string& quantity : first.quantities) {
    const bool is_of_force = quantity == first.force || quantity == first.vibration;
    const bool is_told =
        (is_of_force && !first.load_factor.empty()) || is_never_apart(sides, quantity);
    if (is_told || quantity == "contact_class" || !all_have(sides, quantity)) continue;
    if (quantity == first.iso_load_factor && all_have_factors(sides)) {
      append(figures_of(sides,
                        {"factor",
                         {"line.nc", "factor.nc"},
                         quantity,
                         false,
                         {"largest mesh force / static force", "K_v, ISO 6336-1 method B"}},
                        "Dynamic load factor, and the dynamic factor K<sub>v</sub> of ISO "
                        "6336-1:2006 by method B, over the speed"),
             &figures);
    } else {
      append(figures_of(sides, {quantity, {"line.nc"}, quantity}, caption_for(first, quantity)),
             &figures);
    }
  }
  return figures;
}

// Over both axes, where each study has two.
std::vector<HtmlFigure> maps(const Sides& sides) {
  std::vector<HtmlFigure> figures;
  const auto has_map = [](const ReportFindings& findings) { return findings.at.has_value(); };
  if (!std::ranges::all_of(sides, has_map)) return figures;
  const std::string& force =
      sides.front().load_factor.empty() ? sides.front().force : sides.front().load_factor;
  for (const std::string& quantity : {force, std::string("contact_class")}) {
    if (!all_have(sides, quantity)) continue;
    append(figures_of(
               sides, {"map-" + quantity, {"map.nc"}, quantity, true, {}, kFigureHeightWithKey},
               caption_for(sides.front(), quantity) + " and " + html_text(sides.front().at->first)),
           &figures);
  }
  return figures;
}

// A jump of a run between neighbouring speeds.
struct Jump {
  std::string run;
  const ResultMap* map = nullptr;
  std::size_t from = 0, to = 0;  // points

  double size() const { return std::abs(map->values[to] - map->values[from]); }
};

// Where no jump is told though the curves part: at too few speeds, or by chance.
std::string no_jump_html(const ReportFindings& findings, const ResultMap& up,
                         const ResultMap& down) {
  constexpr double kVisible = 0.02;  // of the largest
  const double most = std::max(up.values[largest_of(up.values).value_or(0)],
                               down.values[largest_of(down.values).value_or(0)]);
  std::vector<std::string> speeds;
  for (std::size_t point = 0; point < up.values.size(); ++point) {
    if (!(std::abs(up.values[point] - down.values[point]) > kVisible * most)) continue;
    speeds.push_back(speed_html(findings, findings.orders.forcing[point]));
  }
  if (speeds.empty()) return "Run-up and run-down are the same: no jump was found.";
  return fmt::format(
      "Run-up and run-down part at {} of {} speeds, from {} to {}. No jump between neighbouring "
      "speeds is clear enough to be told: take more speeds there. Chaotic motions part by chance.",
      speeds.size(), up.values.size(), speeds.front(), speeds.back());
}

void add_jumps(const ReportFindings& findings, HtmlPage* page) {
  const ResultMap up = findings.over_speed("up.nc", findings.force);
  const ResultMap down = findings.over_speed("down.nc", findings.force);
  std::vector<Jump> jumps;
  for (const Hysteresis& part : find_hysteresis(up, down)) {
    if (part.jumps_up) jumps.push_back({"run-up", &up, part.last, part.last + 1});
    if (part.jumps_down) jumps.push_back({"run-down", &down, part.first, part.first - 1});
  }
  if (jumps.empty()) {
    page->paragraph(no_jump_html(findings, up, down));
    return;
  }
  std::sort(jumps.begin(), jumps.end(),
            [](const Jump& a, const Jump& b) { return a.size() > b.size(); });
  constexpr std::size_t kMost = 5;
  HtmlTable table;
  table.head = {"jump in", "between", quantity_cell(findings, up) + " before", "after"};
  for (const Jump& jump : jumps) {
    if (table.rows.size() == kMost) break;
    table.rows.push_back(
        {jump.run,
         fmt::format("{} and {}", speed_html(findings, findings.orders.forcing[jump.from]),
                     speed_html(findings, findings.orders.forcing[jump.to])),
         value_cell(*jump.map, jump.from), value_cell(*jump.map, jump.to)});
  }
  page->table(table);
  if (jumps.size() > kMost) {
    page->small(fmt::format(
        "These are the largest of {}. Where the motion is chaotic, the two runs differ by chance.",
        jumps.size()));
  }
}

}  // namespace

void add_pictures(const Sides& sides, HtmlPage* page) {
  page->heading("Over the speed: force, contact, orders, run-up and run-down");
  std::vector<HtmlFigure> figures = curves(sides);
  append(maps(sides), &figures);
  append(
      order_figures(sides, fmt::format("Order map: amplitudes of the {} at each speed. White: "
                                       "natural frequencies; {}",
                                       order_signal_html(sides.front()), rays_html(sides.front()))),
      &figures);
  const bool have_directions = std::ranges::all_of(
      sides, [](const ReportFindings& findings) { return findings.has_directions; });
  if (have_directions) {
    append(figures_of(sides,
                      {"directions",
                       {"up.nc", "down.nc"},
                       sides.front().force,
                       false,
                       {},
                       kFigureHeightWithKey},
                      "Run-up and run-down: each speed goes on from the motion at the one before "
                      "it. Where the curves part, two motions exist"),
           &figures);
  }
  page->figures(figures);
  for (const ReportFindings& findings : sides) {
    if (sides.size() > 1) page->subheading(html_text(findings.name));
    if (findings.has_directions) {
      add_jumps(findings, page);
    } else {
      page->paragraph("Run-up and run-down were not computed: " +
                      html_text(findings.no_directions));
    }
  }
  add_dynamic_factor_note(sides.front(), page);
}

}  // namespace gearsweep
