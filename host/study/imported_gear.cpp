#include "study/imported_gear.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "study/draft.hpp"
#include "study/gear_text.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

constexpr const char* kEstimates =
    "ESTIMATE marks what the file does not give: put your own numbers there. Keys behind a # are "
    "others that a drawing may have.\n";

double parameter_of(const Study& study, const std::string& name) {
  const int index = study.model->find_parameter(name);
  return index < 0 ? 0.0 : study.setting.parameters[static_cast<std::size_t>(index)];
}

// All load cases; throws InputError with all that is missing.
std::vector<GearTextLoad> spectrum_of(const std::vector<DrawnLoad>& cases,
                                      const std::string& source) {
  if (cases.size() < 2) {
    throw InputError(fmt::format(
        "{}: it has one load, which is no load spectrum: leave out --spectrum", source));
  }
  std::vector<GearTextLoad> loads;
  std::string missing;
  for (const DrawnLoad& one : cases) {
    loads.push_back({one.torque.value_or(0.0), one.speed.value_or(0.0), one.share.value_or(0.0)});
    std::vector<std::string> lacks;
    if (!one.torque) lacks.emplace_back("a torque (torque_around_u_axis of its external loads)");
    if (!one.speed) lacks.emplace_back("a speed (rotational_speed of a shaft)");
    if (!one.share) lacks.emplace_back("a share of the time (load_duration_fraction)");
    if (lacks.empty()) continue;
    missing += fmt::format("\n  load case {} has not {}", one.id, fmt::join(lacks, ", nor "));
  }
  if (missing.empty()) return loads;
  throw InputError(fmt::format(
      "{}: its load cases make no load spectrum, for{}\nLeave out --spectrum, and write the loads "
      "as [points] with the columns torque_N_m, pinion_speed_rpm and time_share",
      source, missing));
}

GearText text_of(const StageDrawing& drawing) {
  GearText text;
  for (const auto& [name, key] : drawing.keys) text.keys[name] = {key.value, key.origin};
  text.teeth = {drawing.teeth[0], drawing.teeth[1]};
  text.module_mm = drawing.module;
  text.face_width_mm = drawing.face_width;
  text.fastest_rpm = drawing.fastest;
  text.tables = drawing.tables;
  return text;
}

// In place of the stiffness that the face width gives for steel, k0 (N/m), that of the materials.
// Helical teeth and discs need the width all the same.
void soften(const StageDrawing& drawing, double k0, GearText* text) {
  text->keys[kMeshStiffness.name] = {
      fmt::format("{:.6g}", k0 * drawing.stiffness_factor),
      fmt::format("computed: by ISO 6336-1 method B for steel, {:.6g}, times {:.4g} for the moduli "
                  "of the materials",
                  k0, drawing.stiffness_factor)};
  text->keys.erase(kDedendum.name);
  const bool needs_width = text->keys.contains(kHelix.name) || !text->keys.contains(kInertia.name);
  if (!needs_width) text->keys.erase(kFaceWidth.name);
}

// Where the file and the study disagree on the contact ratio.
void compare_contact_ratio(const StageDrawing& drawing, double ours, const std::string& where,
                           std::vector<std::string>* notes) {
  constexpr double kNear = 0.02;  // programs take it to other tip circles
  if (!drawing.contact_ratio || std::fabs(ours / *drawing.contact_ratio - 1.0) <= kNear) return;
  notes->push_back(
      fmt::format("{}the transverse contact ratio is {:.4g} here, and {:.4g} in the file: look at "
                  "tip_diameter_mm",
                  where, ours, *drawing.contact_ratio));
}

}  // namespace

ImportedGear imported_gear_study(const StageDrawing& drawing, const std::string& source,
                                 ImportedPoints points) {
  const bool is_spectrum = points == ImportedPoints::load_spectrum;
  GearText text = text_of(drawing);
  if (is_spectrum) text.spectrum = spectrum_of(drawing.cases, source);
  text.title = fmt::format("{}: {}/{} teeth, module {:g} mm", source, drawing.teeth[0],
                           drawing.teeth[1], drawing.module);
  text.about = drawing.about + (is_spectrum ? "" : text_of(drawing.cases)) + kEstimates;
  if (drawing.stiffness_factor != 1.0) {
    soften(drawing, read_draft(gear_text(text, source), source).scales.k0, &text);
  }
  ImportedGear out = {gear_text(std::move(text), source), drawing.notes};
  out.notes.insert(out.notes.end(), drawing.bearing_notes.begin(), drawing.bearing_notes.end());
  const Study study = read_study(out.toml, source);
  for (const std::string& notice : study.notices) out.notes.push_back(notice);
  compare_contact_ratio(drawing, parameter_of(study, "eps"), "", &out.notes);
  return out;
}

ImportedGear imported_unit_study(const UnitDrawing& drawing, const std::string& source,
                                 ImportedPoints points) {
  UnitText text;
  text.title = fmt::format("{}: {}", source, drawing.summary);
  text.about = drawing.about + kEstimates;
  text.model = drawing.model;
  text.options = drawing.options;
  for (const DrawnParameter& one : drawing.parameters) {
    text.parameters.push_back({one.name, one.value, one.origin, one.is_default});
  }
  for (const auto& [name, one] : drawing.drawings) text.drawings.emplace_back(name, text_of(one));
  if (points == ImportedPoints::load_spectrum) {
    text.drawings.front().second.spectrum =
        spectrum_of(drawing.drawings.front().second.cases, source);
  }
  const std::string draft_text = unit_text(text, source);
  const Study draft = read_draft(draft_text, source);
  bool is_soft = false;
  for (std::size_t i = 0; i < drawing.drawings.size(); ++i) {
    const auto& [name, one] = drawing.drawings[i];
    if (one.stiffness_factor == 1.0) continue;
    soften(one, parameter_of(draft, "k0_" + name), &text.drawings[i].second);
    is_soft = true;
  }
  ImportedGear out = {is_soft ? unit_text(text, source) : draft_text, drawing.notes};
  const Study study = read_study(out.toml, source);
  for (const auto& [name, one] : drawing.drawings) {
    const std::string where = fmt::format("[gear.{}] ", name);
    for (const std::string& note : one.notes) out.notes.push_back(where + note);
    compare_contact_ratio(one, parameter_of(study, "eps_" + name), where, &out.notes);
  }
  for (const std::string& notice : study.notices) out.notes.push_back(notice);
  return out;
}

}  // namespace gearsweep
