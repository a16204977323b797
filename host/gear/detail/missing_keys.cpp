#include "gear/detail/missing_keys.hpp"

#include <fmt/format.h>

#include <vector>

namespace gearsweep {
namespace {

// Whether something else that the drawing has stands for the key.
bool is_replaced(const GearKey& key, const GearDrawing& drawing) {
  if (key.name == kMass.name || key.name == kInertia.name) return drawing.choice(kBody) == "solid";
  if (key.name == kMeshDamping.name) return drawing.has(kDampingRatio);
  if (key.name == kTransmissionError.name) return drawing.has(kErrorFile);
  if (key.name == kTorque.name) return drawing.has(kTorqueFile);
  if (key.name == kFaceWidth.name) {
    return drawing.has(kMeshStiffness) || drawing.has(kStiffnessFile);
  }
  return false;
}

bool is_needed(const GearKey& key) {
  return key.fallback == "required" || key.fallback.starts_with("needed without");
}

}  // namespace

void require_keys(const GearDrawing& drawing, const GearTarget& target) {
  std::vector<const GearKey*> missing;
  for (const GearKey& key : kGearKeys) {
    if (!is_needed(key) || drawing.has(key) || is_replaced(key, drawing)) continue;
    if (target.takes(key)) missing.push_back(&key);
  }
  if (missing.empty()) return;
  std::string text = missing.size() == 1
                         ? fmt::format("{} needs", drawing.name())
                         : fmt::format("{} needs {} more keys:", drawing.name(), missing.size());
  for (const GearKey* key : missing) {
    text += fmt::format("{}'{}' ({}){}{}", missing.size() == 1 ? " " : "\n  ", key->name,
                        key->meaning, key->advice.empty() ? "" : ": ", key->advice);
  }
  throw DrawingError(*missing.front(), text);
}

}  // namespace gearsweep
