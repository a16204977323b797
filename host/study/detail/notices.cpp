#include "study/detail/notices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

bool is_override(const toml::node& node) { return place_of(node).starts_with("--set"); }

// By an axis; a draw of an uncertain parameter is around what the study gives.
bool is_swept(const Study& study, const std::string& name) {
  return std::ranges::any_of(study.axes, [&](const Axis& axis) {
    return std::ranges::any_of(axis.swept(), [&](const Swept& one) { return one.name == name; });
  });
}

// A point of a chain depends on all those before it.
void note_moved_chain(const toml::table& root, Study* study) {
  if (!study->is_chained() || study->axes.empty()) return;
  const Axis& axis = study->axes[study->initial.along];
  if (axis.is_list) return;
  const toml::node* from = (*root["axes"].as_array())[study->initial.along].as_table()->get("from");
  if (from == nullptr || !place_of(*from).starts_with("--zoom")) return;
  study->notices.push_back(fmt::format(
      "{}: the points of this study go on from their neighbours along '{}', and their chain now "
      "begins elsewhere: it may reach other motions",
      place_of(*from), axis.name));
}

}  // namespace

// What the command line or [parameters] gives beside an axis or the [gear] table. What a file gives
// beside an axis is what it had before the axis, and no mistake.
void note_what_wins(const toml::table& root, const std::vector<StudyDrawing>& drawings,
                    Study* study) {
  const auto note = [&](const toml::node& loser, const std::string& name, const char* over = "") {
    if (!is_override(loser) || !is_swept(*study, name)) return;
    study->notices.push_back(
        fmt::format("{}: the axis '{}' of the study wins{}", place_of(loser), name, over));
  };
  const auto note_parameter = [&](const toml::node& node, const StudyDrawing& drawing,
                                  const GearParameter& one) {
    if (is_swept(*study, one.name)) return;
    const int index = study->model->find_parameter(one.name);
    study->notices.push_back(fmt::format("{}: {} = {} wins over {} of {}, which gives {:.6g}",
                                         place_of(node), one.name,
                                         study->setting.parameters[static_cast<std::size_t>(index)],
                                         one.key, drawing.from.heading, one.value));
  };
  if (const toml::table* parameters = root["parameters"].as_table()) {
    for (const auto& [key, node] : *parameters) {
      note(node, std::string(key.str()));
      for (const StudyDrawing& drawing : drawings) {
        for (const GearParameter& one : drawing.gives.parameters) {
          if (one.name == key.str()) note_parameter(node, drawing, one);
        }
      }
    }
  }
  for (const StudyDrawing& drawing : drawings) {
    for (const GearParameter& one : drawing.gives.parameters) {
      const toml::node* node = drawing.from.table->get(one.key);
      if (node != nullptr) note(*node, one.name, " over what follows from this");
    }
  }
  note_moved_chain(root, study);
  if (const toml::table* state = root["initial"]["state"].as_table()) {
    for (const auto& [key, node] : *state) note(node, std::string(key.str()));
  }
}

// At both ends of the axes; uncertain parameters have their nominal values.
void note_what_the_model_says(Study* study) {
  if (!study->model->notices) return;
  for (const bool is_first : {true, false}) {
    ModelSetting setting = study->setting;
    for (const Axis& axis : study->axes) {
      for (const Swept& swept : axis.swept()) {
        if (swept.is_state || swept.values.empty()) continue;
        setting.parameters[swept.index] = is_first ? swept.values.front() : swept.values.back();
      }
    }
    if (!study->model->check(setting).empty()) continue;
    for (const std::string& notice : study->model->notices(setting)) {
      if (std::ranges::find(study->notices, notice) != study->notices.end()) continue;
      study->notices.push_back(notice);
    }
  }
}

}  // namespace gearsweep
