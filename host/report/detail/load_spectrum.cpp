#include "report/detail/load_spectrum.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "model/version.hpp"
#include "plot/labels.hpp"
#include "report/detail/assumptions.hpp"
#include "report/detail/findings.hpp"
#include "report/detail/html.hpp"
#include "report/detail/names.hpp"
#include "report/detail/page_file.hpp"
#include "report/detail/words.hpp"
#include "result/load_spectrum.hpp"
#include "result/output_file.hpp"
#include "result/si_units.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// "812 N (81.4 N m)", of a study without a drawing "0.0912 k0 b_n".
std::string load_html(const Study& study, const SpectrumForce& force, double value) {
  if (std::isnan(value)) return "unknown";
  const std::string& unit = study.model->parameters[force.load].unit;
  const SiUnit si = study.scales.known() ? si_unit(unit, study.scales) : SiUnit{};
  std::string text = si.scale > 0.0 ? fmt::format("{} {}", html_number(si.scale * value), si.name)
                                    : fmt::format("{} {}", html_number(value), html_unit(unit));
  if (const std::optional<double> torque = torque_per_load(study, force)) {
    text += fmt::format(" ({} N m)", html_number(*torque * value));
  }
  return text;
}

std::string parting_html(const SpectrumAnswers& answers) {
  if (!answers.parting_share) return "";
  if (std::isnan(*answers.parting_share)) return ", and whether teeth part is not known";
  if (answers.parting.empty()) return ", and teeth stay in contact under all loads";
  return fmt::format(", and teeth part under loads that last {} of the time",
                     html_percent(*answers.parting_share));
}

// The force with the largest factor; a factor that is not known comes before all.
const SpectrumForce& worst_of(const SpectrumAnswers& answers) {
  return *std::ranges::max_element(answers.forces, {}, [](const SpectrumForce& one) {
    return std::isnan(one.max_factor) ? std::numeric_limits<double>::infinity() : one.max_factor;
  });
}

// "force between the teeth", of several "force of the second mesh".
std::string force_words(const Study& study, const SpectrumForce& force) {
  const std::vector<ChannelInfo> all = study.model->signals_of(Role::mesh_force);
  const auto own = std::ranges::find_if(
      all, [&](const ChannelInfo& one) { return force.factor.starts_with(one.name + "_"); });
  return all.size() < 2 || own == all.end() ? "force between the teeth"
                                            : html_text(force_words(*own));
}

std::string spectrum_html(const Study& study, const SpectrumAnswers& answers) {
  if (answers.forces.empty()) return "The model has no load factor.";
  const SpectrumForce& force = worst_of(answers);
  if (std::isnan(force.mean_factor)) {
    return "The load factor of the spectrum is not known: a load that lasts has no value.";
  }
  return fmt::format(
      "The largest {} is {:.3g} times the load on average over the time, and {:.3g} times under "
      "load "
      "{}, where it is largest{}.",
      force_words(study, force), force.mean_factor, force.max_factor, force.max_point + 1,
      parting_html(answers));
}

std::vector<std::string> equivalents_html(const Study& study, const SpectrumAnswers& answers) {
  std::vector<std::string> remarks;
  for (const SpectrumForce& force : answers.forces) {
    const auto worst = std::ranges::max_element(force.damage) - force.damage.begin();
    remarks.push_back(fmt::format(
        "{} of {} does the damage of all loads, by Miner's rule with the slope {:g} (ISO "
        "6336-6); of the largest forces under them it is {}.{}",
        answers.forces.size() == 1 ? "A load" : "Of the " + force_words(study, force) + ": a load",
        load_html(study, force, force.equivalent_load), study.spectrum->slope,
        load_html(study, force, force.equivalent_force),
        std::isnan(force.equivalent_force)
            ? ""
            : fmt::format(" Load {} does {} of that damage.", worst + 1,
                          html_percent(force.damage[static_cast<std::size_t>(worst)]))));
  }
  if (!answers.failed.empty()) {
    std::vector<std::size_t> numbers;
    for (const std::size_t point : answers.failed) numbers.push_back(point + 1);
    remarks.push_back(fmt::format("Without values, so that what rests on them is unknown: load {}.",
                                  fmt::join(numbers, ", ")));
  }
  return remarks;
}

// A load to the row: what the list says, then the maps.
HtmlTable loads_of(const Study& study, const ResultFile& file) {
  HtmlTable table;
  table.is_numbers = true;
  table.head = {"load"};
  std::vector<std::vector<std::string>> columns;
  for (const std::string& name : study.axes.front().listed) {
    const Swept& column = *study.axes.front().find_column(name);
    const bool is_share = name == kTimeShare;
    const std::string unit = is_share || column.unit == "1" ? "" : html_unit(column.unit);
    table.head.push_back(html_named(
        html_text(column.meaning) + (unit.empty() ? "" : fmt::format(" ({})", unit)), name));
    std::vector<std::string>& cells = columns.emplace_back();
    for (std::size_t point = 0; point < column.values.size(); ++point) {
      cells.push_back(is_share ? html_percent(study.spectrum->shares[point])
                               : html_number(column.values[point]));
    }
  }
  for (const std::string& quantity : file.quantities()) {
    ResultMap map = file.read(quantity);
    if (quantity == "status" || map.part_count() * map.samples > 1) continue;
    if (study.scales.known()) convert_to_si(study.scales, &map);
    table.head.push_back(quantity_cell(*study.model, map));
    std::vector<std::string>& cells = columns.emplace_back();
    for (std::size_t point = 0; point < map.values.size(); ++point) {
      cells.push_back(value_cell(map, point));
    }
  }
  for (std::size_t point = 0; point < study.points(); ++point) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(fmt::format("{}", point + 1));
    for (const std::vector<std::string>& column : columns) row.push_back(column[point]);
  }
  return table;
}

// One study of the page, computed.
struct SpectrumSide {
  std::string name;  // of one of several
  Study study;       // as it was given
  Study observed;
  SpectrumAnswers answers;
  std::unique_ptr<TemporaryFolder> folder = std::make_unique<TemporaryFolder>();

  std::string file() const { return (folder->path() / "loads.nc").string(); }
  std::string of(const std::string& heading) const {
    return name.empty() ? heading : fmt::format("{}: {}", html_text(name), heading);
  }
};

// Nothing when stopped.
std::optional<SpectrumSide> run_side(const ReportStudy& given, bool is_alone,
                                     const ReportOptions& options) {
  SpectrumSide side;
  side.name = is_alone ? "" : given.name;
  side.study = given.study;
  // What it observes does not matter.
  side.observed = read_study(given.study.toml, "the study of the report", {"observe={}"});
  if (options.on_step) options.on_step(side.of("loads of the spectrum"));
  const std::optional<SweepResult> result = run_sweep(side.observed, options.sweep_options());
  if (!result) return std::nullopt;
  write_result(*result, side.file(), {options.command_line, version(), source_hash()});
  side.answers = spectrum_answers(*result);
  return side;
}

void add_notes(const Study& study, HtmlPage* page) {
  std::vector<std::string> notes;
  for (const std::string& assumption : study.model->assumptions) {
    notes.push_back(html_text(assumption));
  }
  notes.push_back(
      fmt::format("Up to {} forcing periods settle, {} are recorded. Each load starts {}.",
                  study.integrate.settle, study.integrate.record,
                  html_text(info_of(study.initial.policy).meaning)));
  page->begin_columns();
  page->small_list(notes);
  page->end_columns();
}

}  // namespace

bool write_spectrum_report(const ReportStudies& studies, const std::string& title,
                           const std::string& path, const ReportOptions& options) {
  std::vector<SpectrumSide> sides;
  for (const ReportStudy& one : studies) {
    std::optional<SpectrumSide> side = run_side(one, studies.size() == 1, options);
    if (!side) return false;
    sides.push_back(*std::move(side));
  }
  HtmlPage page(title);
  for (const SpectrumSide& one : sides) {
    page.answer(one.of(spectrum_html(one.observed, one.answers)),
                equivalents_html(one.observed, one.answers));
  }
  for (const SpectrumSide& one : sides) {
    page.heading(one.of("Loads"));
    page.table(loads_of(one.observed, ResultFile(one.file())));
  }
  for (const SpectrumSide& one : sides) {
    page.heading(one.of("What was given, and what was assumed"));
    add_assumed_values(one.study, &page);
    add_notes(one.study, &page);
  }
  page.small(fmt::format("gearsweep {}: <code>{}</code>", html_text(version()),
                         html_text(options.command_line)));
  write_page(page, path);
  return true;
}

}  // namespace gearsweep
