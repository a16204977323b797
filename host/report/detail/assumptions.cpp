#include "report/detail/assumptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "gear/drawing_keys.hpp"
#include "model/names.hpp"
#include "plot/labels.hpp"
#include "report/detail/html.hpp"
#include "report/detail/names.hpp"
#include "report/detail/sections.hpp"
#include "report/detail/words.hpp"
#include "result/si_units.hpp"
#include "study/initial_policy.hpp"

namespace gearsweep {
namespace {

constexpr const char *kYours = "yours", *kEstimated = "<b>estimated</b>", *kDefault = "default";

// Numbers as a table has them: "217400000, 1" as 2.174e+08, 1.
std::string shown_value(const std::string& text) {
  std::vector<std::string> parts;
  for (const std::string& part : split(text, ',')) {
    char* end = nullptr;
    const double number = std::strtod(part.c_str(), &end);
    if (part.empty() || *end != '\0') return html_text(text);
    parts.push_back(html_number(number));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

AssumedValue assumed_datum(const GearDatum& datum) {
  const auto [words, unit] = words_and_unit(std::string(datum.key));
  AssumedValue assumed;
  assumed.what = html_text(datum.drawing.empty() ? words : datum.drawing + ": " + words);
  assumed.value = shown_value(datum.value);
  const bool is_number = std::isdigit(static_cast<unsigned char>(datum.value.front())) != 0;
  if (is_number && !unit.empty()) assumed.value += " " + unit;
  assumed.origin = datum.origin == DatumOrigin::given       ? kYours
                   : datum.origin == DatumOrigin::estimated ? kEstimated
                                                            : kDefault;
  if (!datum.reason.empty()) assumed.origin += ": " + html_text(datum.reason);
  assumed.is_nothing = datum.origin == DatumOrigin::by_default && datum.value == "0";
  return assumed;
}

// Whose a parameter or option is, by where its value comes from.
std::string origin_html(const std::string& origin) {
  if (origin == kDefault) return kDefault;
  if (origin.starts_with(kEstimatedOrigin)) return kEstimated;
  if (origin.starts_with("preset ")) return fmt::format("{}: {}", kDefault, html_text(origin));
  return kYours;
}

bool is_of_drawing(const std::string& origin) { return origin.starts_with("[gear"); }

// "kappa" of "kappa_2", where the model has that, too: parameters in a list are told together.
std::string list_of(const Model& model, const std::string& parameter) {
  const std::size_t digits = parameter.find_last_not_of("0123456789");
  if (digits + 1 >= parameter.size() || parameter[digits] != '_') return "";
  const std::string stem = parameter.substr(0, digits);
  return model.find_parameter(stem) < 0 ? "" : stem;
}

// What a drawing does not have of a parameter that it may give is told by its keys, and how long
// the forcing's period is follows from its faults.
bool is_of_key(const Study& study, std::size_t index) {
  const Model& model = *study.model;
  const std::string& name = model.parameters[index].name;
  if (study.gear_data.empty()) return false;
  if (std::ranges::count(model.cycle_parameters, index) > 0) return true;
  const std::string stem = list_of(model, name);
  return std::ranges::any_of(kGearKeys, [&](const GearKey& key) {
    return std::ranges::any_of(key.gives, [&](std::string_view given) {
      return !given.empty() && (given == stem || given == name);
    });
  });
}

std::vector<AssumedValue> parameter_values(const Study& study) {
  std::vector<AssumedValue> values;
  const Model& model = *study.model;
  std::string last;  // of the values: its parameter, or the list that it began
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    const std::string& origin = study.parameter_origins[i];
    const bool is_told =
        is_of_drawing(origin) || study.differs(i) || (origin == kDefault && is_of_key(study, i));
    if (is_told || !model.uses_parameter(info.name)) continue;
    const double value = study.setting.parameters[i];
    const std::string number = html_number(value);
    const bool is_nothing = origin == kDefault && value == 0.0;
    const std::string list = list_of(model, info.name);
    // What a drawing's list does not have is nothing to tell.
    if (!list.empty() && list != last && is_nothing) continue;
    if (!list.empty() && list == last) {
      values.back().value += ", " + number;
      values.back().is_nothing = values.back().is_nothing && is_nothing;
      continue;
    }
    last = info.name;
    const std::string unit = html_unit(info.unit);
    values.push_back(
        {html_named(html_text(info.meaning.empty() ? info.name : info.meaning), info.name) +
             (unit.empty() ? "" : fmt::format(" ({})", unit)),
         number, origin_html(origin), is_nothing});
  }
  return values;
}

std::vector<AssumedValue> option_values(const Study& study) {
  std::vector<AssumedValue> values;
  const Model& model = *study.model;
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const OptionInfo& option = model.options[i];
    const std::string& origin = study.option_origins[i];
    values.push_back({html_named(html_text(option.meaning), option.name),
                      html_text(option.choices[static_cast<std::size_t>(study.setting.options[i])]),
                      is_of_drawing(origin) ? "follows from yours" : origin_html(origin), false});
  }
  return values;
}

std::string axis_html(const Axis& axis, const ReportFindings& findings) {
  const SiUnit si = shown_unit(axis.unit, findings.study.scales);
  const bool is_si = findings.is_si() && si.scale > 0.0;
  const double scale = is_si ? si.scale : 1.0;
  const std::string unit = is_si ? html_text(si.name) : html_unit(axis.unit);
  return fmt::format(
      "{} from {} to {}{}, {} values",
      html_named(html_text(axis.meaning.empty() ? axis.name : axis.meaning), axis.name),
      html_number(scale * axis.values.front()), html_number(scale * axis.values.back()),
      unit.empty() ? "" : " " + unit, axis.values.size());
}

// What the model leaves out, and how the motions were computed. HTML.
std::vector<std::string> sentences(const ReportFindings& findings) {
  const Study& study = findings.study;
  const Model& model = *study.model;
  std::vector<std::string> notes;
  for (const std::string& assumption : model.assumptions) notes.push_back(html_text(assumption));
  const std::vector<ChannelInfo> forces = model.signals_of(Role::mesh_force);
  if (forces.size() > 1) {
    notes.push_back(fmt::format(
        "The model has {} forces between teeth. Speeds are ranked by the {}, and run-up and "
        "run-down are of this force; the order map is that of the {}.",
        forces.size(), named_html(findings, findings.ranking),
        html_text(force_words(findings.orders.channel))));
  }
  std::vector<std::string> axes;
  for (const Axis& axis : study.axes) axes.push_back(axis_html(axis, findings));
  const Integrate& integrate = study.integrate;
  notes.push_back(fmt::format(
      "Swept: {}. Up to {} forcing periods settle, {} are recorded; the order map records {}. Each "
      "point starts {}; run-up and run-down go on from their neighbour. The natural frequencies "
      "are those of the first of the speeds.",
      fmt::join(axes, "; "), integrate.settle, integrate.record,
      findings.orders.study.integrate.record, html_text(info_of(study.initial.policy).meaning)));
  return notes;
}

// Where each parameter of the model comes from, for who wants to compute it again.
void add_parameters(const ReportFindings& findings, HtmlPage* page) {
  const Study& study = findings.given;
  const Model& model = *study.model;
  page->begin_details("What follows from the drawing, and all parameters of the model");
  std::vector<std::string> notes;
  for (const std::string& note : study.gear_notes) notes.push_back(html_text(note));
  for (const std::string& finding : model.findings) notes.push_back(html_text(finding));
  page->list(notes);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    const bool is_swept = study.find_on_axes(i) != nullptr;
    const DerivedParameter* const derived = study.differs(i) ? model.find_derived(i) : nullptr;
    rows.push_back({html_text(info.name),
                    is_swept             ? "swept"
                    : derived != nullptr ? html_text("= " + derived->expression)
                                         : html_number(study.setting.parameters[i]),
                    html_unit(info.unit), html_text(info.meaning),
                    html_text(study.parameter_origins[i])});
  }
  page->table({"parameter", "value", "unit", "meaning", "from"}, rows);
  page->end_details();
}

}  // namespace

std::vector<AssumedValue> assumed_values(const Study& study) {
  std::vector<AssumedValue> values;
  for (const GearDatum& datum : study.gear_data) values.push_back(assumed_datum(datum));
  std::ranges::move(parameter_values(study), std::back_inserter(values));
  std::ranges::move(option_values(study), std::back_inserter(values));
  return values;
}

void add_assumed_values(const Study& study, HtmlPage* page) {
  HtmlTable table;
  std::vector<std::string> nothing;
  for (const AssumedValue& value : assumed_values(study)) {
    if (value.is_nothing) {
      nothing.push_back(value.what);
    } else {
      table.rows.push_back({value.what, value.value, value.origin});
    }
  }
  page->begin_columns();
  page->table(table);
  page->end_columns();
  if (!nothing.empty()) {
    page->small(fmt::format("0 by default: {}.", fmt::join(nothing, ", ")));
  }
}

void add_assumptions(const Sides& sides, HtmlPage* page) {
  const ReportFindings& findings = sides.front();
  const Study& study = findings.given;
  page->heading("What was given, and what was assumed");
  page->paragraph(fmt::format(
      "{}: {}. Yours is what the study says; an estimate or a default can be wrong for these gears."
      "{}",
      html_text(study.model->name), html_text(study.model->summary),
      sides.size() > 1 ? fmt::format(" Of {}; how the other one differs stands at the top.",
                                     html_text(findings.name))
                       : ""));
  add_assumed_values(study, page);
  page->begin_columns();
  page->small_list(sentences(findings));
  page->end_columns();
  add_parameters(findings, page);
}

}  // namespace gearsweep
