#include "study/detail/study_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "study/detail/drawing_axis.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// What a drawing gives. own: [model], whose options win.
void take_in_drawing(const DrawingTable& from, const GearConversion& gear, const toml::table* own,
                     Study* study) {
  if (from.suffix.empty()) {
    study->scales = gear.scales;
    study->dynamic_factor = gear.dynamic_factor;
  } else if (gear.dynamic_factor) {
    fail_at(*from.table, "K_v is of a study with one gear pair, whose deviations are in [gear]");
  }
  for (const std::string& note : gear.notes) {
    study->gear_notes.push_back(from.suffix.empty() ? note : from.heading + " " + note);
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
  return drawings;
}

}  // namespace gearsweep
