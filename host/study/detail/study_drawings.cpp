#include "study/detail/study_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "gear/drawing_keys.hpp"
#include "study/detail/definition_lists.hpp"
#include "study/detail/drawing_axis.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// The drawing in whose units the model is needs one: K_v stands beside the load factor of a report.
void require_load_factor(const DrawingTable& from, const Model& model) {
  const std::optional<std::size_t> load = model.parameter_of(Role::load);
  if (load && model.signals_of(Role::mesh_force).size() == 1 &&
      model.parameters[*load].name.ends_with(from.suffix)) {
    return;
  }
  fail_at(node_of(from, kPitchDeviation.name),
          fmt::format("K_v stands beside dynamic_load_factor, for which model '{}' needs a "
                      "parameter of the role \"load\" whose name ends in {}, and one signal of the "
                      "role \"mesh_force\"",
                      model.name, from.suffix));
}

// What the drawing measures the results in, where it is the one whose units the model has.
void take_units(const DrawingTable& from, const GearConversion& gear, Study* study) {
  const Model& model = *study->model;
  const bool is_named = !from.suffix.empty();
  if (!is_named || from.suffix == "_" + model.unit_drawing) {
    study->scales = gear.scales;
    study->dynamic_factor = gear.dynamic_factor;
    if (is_named && gear.dynamic_factor) require_load_factor(from, model);
    return;
  }
  if (!gear.dynamic_factor) return;
  const std::string where = model.unit_drawing.empty()
                                ? "its [model] has to say which that is: units = \"NAME\""
                                : fmt::format("[gear.{}]", model.unit_drawing);
  fail_at(node_of(from, kPitchDeviation.name),
          fmt::format("K_v is of the drawing in whose units model '{}' is: {}", model.name, where));
}

bool has_unit_of_drawing(const std::vector<ChannelInfo>& channels) {
  return std::ranges::any_of(channels,
                             [](const ChannelInfo& one) { return is_drawing_unit(one.unit); });
}

void note_missing_units(const std::vector<StudyDrawing>& drawings, Study* study) {
  const Model& model = *study->model;
  if (drawings.empty() || study->scales.known()) return;
  if (!has_unit_of_drawing(model.states) && !has_unit_of_drawing(model.signals)) return;
  study->notices.push_back(
      model.unit_drawing.empty()
          ? fmt::format("model '{}' has several drawings and does not say in whose units it is, so "
                        "the result has no units of SI: units = \"{}\" in its [model] would",
                        model.name, model.drawings.front())
          : fmt::format("model '{0}' is in the units of the drawing '{1}', and the study has no "
                        "[gear.{1}], so the result has no units of SI",
                        model.name, model.unit_drawing));
}

// Where some of the model's drawings are given: which are not.
void note_missing_drawings(const std::vector<StudyDrawing>& drawings, Study* study) {
  if (drawings.empty()) return;
  for (const std::string& name : study->model->drawings) {
    const bool is_given = std::ranges::any_of(
        drawings, [&](const StudyDrawing& drawing) { return drawing.from.suffix == "_" + name; });
    if (is_given) continue;
    study->notices.push_back(
        fmt::format("the study has no [gear.{0}], so the parameters of the drawing '{0}' have the "
                    "values of model '{1}' itself",
                    name, study->model->name));
  }
}

// What a drawing gives. own: [model], whose options win.
void take_in_drawing(const DrawingTable& from, const GearConversion& gear, const toml::table* own,
                     Study* study) {
  take_units(from, gear, study);
  for (const std::string& note : gear.notes) {
    study->gear_notes.push_back(from.suffix.empty() ? note : from.heading + " " + note);
  }
  for (GearDatum datum : gear.data) {
    if (!from.suffix.empty()) datum.drawing = from.suffix.substr(1);
    study->gear_data.push_back(std::move(datum));
  }
  for (const GearDoubt& doubt : gear.doubts) {
    study->notices.push_back(fmt::format("{}: {}", place_of(node_of(from, doubt.key)), doubt.text));
  }
  for (const GearParameter& parameter : gear.parameters) {
    const auto index = static_cast<std::size_t>(study->model->find_parameter(parameter.name));
    study->setting.parameters[index] = parameter.value;
    study->expressions.erase(parameter.name);
    study->parameter_origins[index] = from.heading + ": " + parameter.note;
  }
  for (const GearOption& option : gear.options) {
    if (own != nullptr && own->contains(option.name)) continue;
    const auto index = static_cast<std::size_t>(study->model->find_option(option.name));
    const std::vector<std::string>& choices = study->model->options[index].choices;
    study->setting.options[index] =
        static_cast<int>(std::ranges::find(choices, option.choice) - choices.begin());
    study->option_origins[index] = from.heading;
  }
}

}  // namespace

std::vector<StudyDrawing> read_drawings(const toml::table& root, Study* study) {
  std::vector<StudyDrawing> drawings;
  for (const DrawingTable& from : drawing_tables(root, *study->model)) {
    if (from.table == nullptr) continue;
    const GearValues values = first_values(root, *study->model, from, study->axes);
    drawings.push_back({from, convert_gear(read_drawing(from, values), *study->model, from)});
    take_in_drawing(from, drawings.back().gives, root["model"].as_table(), study);
  }
  note_missing_drawings(drawings, study);
  note_missing_units(drawings, study);
  return drawings;
}

}  // namespace gearsweep
