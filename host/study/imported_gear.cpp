#include "study/imported_gear.hpp"

#include <fmt/format.h>

#include <cmath>

#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "study/gear_text.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

constexpr double kNear = 0.02;  // of a contact ratio, which programs take to other tip circles

double contact_ratio_of(const Study& study) {
  const auto& parameters = study.model->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == "eps") return study.setting.parameters[i];
  }
  return 0.0;
}

}  // namespace

ImportedGear imported_gear_study(const StageDrawing& drawing, const std::string& source) {
  GearText text;
  text.title = fmt::format("{}: {}/{} teeth, module {:g} mm", source, drawing.teeth[0],
                           drawing.teeth[1], drawing.module);
  text.about =
      drawing.about +
      "ESTIMATE marks what the file does not give: put your own numbers there. Keys behind "
      "a # are others that a drawing may have.\n";
  for (const auto& [name, key] : drawing.keys) text.keys[name] = {key.value, key.origin};
  text.teeth = {drawing.teeth[0], drawing.teeth[1]};
  text.module_mm = drawing.module;
  text.face_width_mm = drawing.face_width;
  text.fastest_rpm = drawing.fastest;
  ImportedGear out = {gear_text(std::move(text), source), drawing.notes};
  const Study study = read_study(out.toml, source);
  for (const std::string& notice : study.notices) out.notes.push_back(notice);
  const double ours = contact_ratio_of(study);
  if (drawing.contact_ratio && std::fabs(ours / *drawing.contact_ratio - 1.0) > kNear) {
    out.notes.push_back(
        fmt::format("the transverse contact ratio is {:.4g} here, and {:.4g} in the "
                    "file: look at tip_diameter_mm",
                    ours, *drawing.contact_ratio));
  }
  return out;
}

}  // namespace gearsweep
