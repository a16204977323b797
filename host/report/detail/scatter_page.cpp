#include "report/detail/scatter_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "gear/drawing_keys.hpp"
#include "model/version.hpp"
#include "plot/labels.hpp"
#include "plot/plot.hpp"
#include "report/detail/names.hpp"
#include "report/detail/words.hpp"

namespace gearsweep {
namespace {

std::string speed_cell(const ResultMap& map, std::size_t point) {
  const ResultAxis& speed = map.axes.front();
  return fmt::format("{}\u00a0{}", html_number(speed.values[point]), html_unit(speed.unit));
}

// "2.31 ± 0.03", with as many digits as the error has; "about 2.31" where that is not known.
std::string with_error(double value, double error) {
  if (std::isinf(error)) return "about " + html_number(value);
  if (!(error > 0.0)) return html_number(value);
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
  return fmt::format("{:.{}f}\u00a0±\u00a0{:.{}f}", value, digits, error, digits);
}

// What gears are judged by, in words: "load factor".
std::string target_html(const Scatter& scatter) {
  return words_html(*scatter.study.model, scatter.target);
}

std::string scatter_answer(const Scatter& scatter, const ToleranceOptions& options,
                           const ResultMap& target) {
  const Percentile& worst = scatter.percentiles[scatter.worst];
  const std::string unit = html_unit(target.unit);
  const double scale = scatter.scale_of(scatter.target);
  const std::string contact =
      scatter.parting.empty()
          ? ""
          : fmt::format("{} lose contact at some speed; ", html_percent(scatter.parting_anywhere));
  return fmt::format(
      "Of {} gears as built, {}the worst speed is {}, where {:g} % have a {} of at most {}{} "
      "(nominal: {})",
      scatter.gears(), contact, speed_cell(target, scatter.worst), options.percentile,
      target_html(scatter), with_error(worst.value * scale, worst.error * scale),
      unit.empty() ? "" : " " + unit, html_number(target.values[scatter.worst]));
}

// words: what the quantity is called at the axis, if not by its name.
HtmlFigure band_figure(const Scatter& scatter, const std::string& quantity,
                       const std::optional<std::string>& words, const std::string& caption) {
  PlotRequest plot;
  plot.paths = {scatter.file("bands.nc")};
  plot.quantity = quantity;
  plot.output_path = scatter.file(quantity + ".svg");
  plot.style.has_units = true;
  plot.style.is_si = scatter.study.scales.known();
  plot.style.words = words;
  plot.style.title = "";
  plot.style.size = {HtmlPage::kFigureWidth, 57.0, false};
  plot_files(plot);
  return {plot.output_path, caption + "."};
}

void add_band_pictures(const Scatter& scatter, const ToleranceOptions& options, HtmlPage* page) {
  page->heading("Over the speed");
  std::vector<HtmlFigure> figures;
  for (const Quantity& quantity : scatter.study.selection.quantities) {
    if (quantity.of_draws || !quantity.flags.empty()) continue;
    figures.push_back(band_figure(
        scatter, quantity.name, model_words(*scatter.study.model, quantity.name),
        fmt::format("{}: the band has {:g} % of the gears",
                    html_named(words_html(*scatter.study.model, quantity.name), quantity.name),
                    2.0 * options.percentile - 100.0)));
  }
  if (!scatter.parting.empty()) {
    // Of several contacts there is no one share.
    const bool has_one = std::ranges::any_of(
        scatter.study.selection.quantities,
        [](const Quantity& quantity) { return quantity.name == "contact_class"; });
    if (has_one && scatter.parting_anywhere > 0.0) {
      figures.push_back(band_figure(scatter, "contact_class_no_impact_share",
                                    "share of gears that stay in contact",
                                    "Share of the gears whose teeth stay in contact"));
    }
  }
  page->figures(figures);
}

void add_speeds(const Scatter& scatter, const ToleranceOptions& options, const ResultMap& target,
                HtmlPage* page) {
  constexpr std::size_t kShown = 5;
  page->heading("Worst speeds");
  std::vector<double> values;
  for (const Percentile& one : scatter.percentiles) values.push_back(one.value);
  HtmlTable table;
  table.is_numbers = true;
  table.head = {"speed", "nominal", "median", fmt::format("{:g} % stay below", options.percentile),
                "lose contact"};
  const ResultMap median = scatter.map(scatter.target + "_p50");
  const double unit = scatter.scale_of(scatter.target);
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return values[i]; });
  order.resize(std::min(order.size(), kShown));
  for (const std::size_t point : order) {
    const Percentile& one = scatter.percentiles[point];
    table.rows.push_back({speed_cell(target, point), html_number(target.values[point]),
                          html_number(median.values[point]),
                          with_error(one.value * unit, one.error * unit),
                          scatter.parting.empty() ? "–" : html_percent(scatter.parting[point])});
  }
  page->table(table);
  page->small(fmt::format(
      "{}. ± is half of the 95 % interval that {} gears leave (ranks of a binomial distribution); "
      "\"about\": these are too few gears to say.",
      quantity_cell(*scatter.study.model, target), scatter.gears()));
}

// "second: transmission error" of "transmission_error_um_second"; empty of other names. Text.
std::string words_of_drawing_key(const Model& model, const std::string& name) {
  for (const std::string& drawing : model.drawings) {
    const std::string suffix = "_" + drawing;
    if (!name.ends_with(suffix)) continue;
    const std::string stem = name.substr(0, name.size() - suffix.size());
    const bool is_key = std::ranges::any_of(
        kGearKeys, [&](const GearKey& key) { return stem.ends_with(key.name); });
    if (is_key) return fmt::format("{}: {}", drawing, words_and_unit(stem).first);
  }
  return "";
}

// In words, with the name that studies have beside them: a key of the drawing says itself what it
// is.
std::string tolerance_html(const Scatter& scatter, const std::string& name) {
  const std::string of_drawing = words_of_drawing_key(*scatter.study.model, name);
  if (!of_drawing.empty()) return html_named(html_text(of_drawing), name);
  const std::vector<UncertainParameter>& all = scatter.study.uncertain.parameters;
  const auto found =
      std::ranges::find(all, name, [](const UncertainParameter& one) { return one.draws.name; });
  const bool is_key =
      std::ranges::any_of(kGearKeys, [&](const GearKey& key) { return key.name == name; });
  const bool has_meaning =
      found != all.end() && !found->draws.is_list && !is_key && !found->draws.meaning.empty();
  return html_named(html_text(has_meaning ? found->draws.meaning : words_and_unit(name).first),
                    name);
}

// {distribution = "normal", std = 0.05, relative = true} as "normal, std 0.05, relative".
std::string distribution_html(std::string toml) {
  std::erase_if(toml, [](char c) { return c == '{' || c == '}' || c == '"' || c == '\''; });
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = toml.find(from, at)) != std::string::npos; at += to.size()) {
      toml.replace(at, from.size(), to);
    }
  };
  replace("distribution = ", "");
  replace(" = true", "");
  replace(" = ", " ");
  return html_text(toml);
}

void add_ranking(const Scatter& scatter, const ToleranceOptions& options, const ResultMap& target,
                 HtmlPage* page) {
  page->heading("Which tolerance to tighten");
  HtmlTable table;
  table.is_numbers = true;
  table.head = {"tolerance", "alone", "with others", "half as wide"};
  const double scale = scatter.scale_of(scatter.target);
  const double now = scatter.percentiles[scatter.worst].value;
  for (const RankedTolerance& one : scatter.ranking) {
    table.rows.push_back(
        {tolerance_html(scatter, one.name),
         fmt::format("{:.2f}\u00a0±\u00a0{:.2f}", one.first, one.first_error),
         fmt::format("{:.2f}", one.total),
         one.tightened ? fmt::format("{} ({:+.1f}\u00a0%)", html_number(*one.tightened * scale),
                                     100.0 * (*one.tightened / now - 1.0))
                       : "–"});
  }
  page->table(table);
  page->small(fmt::format(
      "At {}: the share of the variance of the {} that each tolerance makes alone (Sobol index of "
      "first order, with its standard error) and with all that it does together with others "
      "(total); and the value below which {:g} % of the gears stay when this tolerance alone is "
      "half as wide, now {}{}. Half of a tolerance of ISO 1328-1 is two classes finer.",
      speed_cell(target, scatter.worst), target_html(scatter), options.percentile,
      html_number(now * scale),
      scatter.tightened_gears < scatter.gears()
          ? fmt::format(" (in proportion to what it is for the first {} gears)",
                        scatter.tightened_gears)
          : ""));
}

// What draws of one parameter are multiplied by where they are factors.
std::string draw_cell(const UncertainParameter& parameter, std::size_t draw) {
  const double value = parameter.draws.values[draw];
  return parameter.is_factor ? fmt::format("×{:.3f}", value) : html_number(value);
}

// One column for each gear: names of parameters are long.
void add_worst_gears(const Scatter& scatter, const ResultMap& target, HtmlPage* page) {
  page->heading("The worst gears");
  HtmlTable table;
  table.is_numbers = true;
  const ResultAxis& speed = target.axes.front();
  const std::string unit = html_unit(speed.unit);
  table.head = {""};
  table.rows = {{target_html(scatter)}, {"at " + (unit == "1" ? html_text(speed.name) : unit)}};
  for (const UncertainParameter& parameter : scatter.study.uncertain.parameters) {
    table.rows.push_back({tolerance_html(scatter, parameter.draws.name)});
  }
  const double scale = scatter.scale_of(scatter.target);
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < scatter.worst_gears.size(); ++i) {
    const WorstGear& gear = scatter.worst_gears[i];
    table.head.push_back(fmt::format("{}", i + 1));
    table.rows[0].push_back(html_number(gear.value * scale));
    table.rows[1].push_back(html_number(speed.values[gear.point]));
    for (std::size_t row = 2; row < table.rows.size(); ++row) {
      table.rows[row].push_back(draw_cell(scatter.study.uncertain.parameters[row - 2], gear.draw));
    }
    std::string settings;
    for (const std::string& one : gear.overrides) settings += fmt::format(" --set '{}'", one);
    commands.push_back(fmt::format("<code>{}</code>", html_text(settings.substr(1))));
  }
  page->table(table);
  page->begin_details("What makes the study each of these gears");
  page->small_list(commands);
  page->end_details();
}

void add_assumed(const Scatter& scatter, HtmlPage* page) {
  if (scatter.assumed.empty()) return;
  page->heading("What was assumed to scatter");
  std::vector<std::vector<std::string>> rows;
  for (const UsualTolerance& one : scatter.assumed) {
    rows.push_back({tolerance_html(scatter, one.name), distribution_html(one.distribution),
                    html_text(one.reason)});
  }
  page->table({"tolerance", "distribution", "why"}, rows);
  page->small("An [uncertain] table in the study takes the place of all of these.");
}

}  // namespace

HtmlPage scatter_page(const Scatter& scatter, const ToleranceOptions& options) {
  const Study& study = scatter.study;
  write_result(scatter.result, scatter.file("bands.nc"),
               {options.command_line, version(), source_hash()});
  HtmlPage page((study.title.empty() ? study.model->name : study.title) + ": gears as built");
  const ResultMap target = scatter.map(scatter.target);
  std::vector<std::string> remarks;
  if (scatter.without_value > 0) {
    remarks.push_back(fmt::format(
        "{} of the gears have no value at some speed: they diverge there, or outgrow their step. "
        "They count in no percentile and no share of that speed.",
        scatter.without_value));
  }
  page.answer(scatter_answer(scatter, options, target), remarks);
  add_band_pictures(scatter, options, &page);
  add_speeds(scatter, options, target, &page);
  add_ranking(scatter, options, target, &page);
  add_worst_gears(scatter, target, &page);
  add_assumed(scatter, &page);
  page.small(fmt::format("gearsweep {}: <code>{}</code>; seed {}, {} trajectories",
                         html_text(version()), html_text(options.command_line),
                         study.uncertain.seed, study.trajectories()));
  return page;
}

}  // namespace gearsweep
