#include "study/new_gear.hpp"

#include <fmt/format.h>

#include "gear/drawing_keys.hpp"
#include "study/gear_text.hpp"

namespace gearsweep {

std::string new_gear_study(const NewGear& gear) {
  GearText text;
  text.teeth = gear.teeth;
  text.module_mm = gear.module_mm;
  text.face_width_mm = gear.face_width_mm;
  text.title =
      fmt::format("Gear pair {}/{}, module {} mm", gear.teeth[0], gear.teeth[1], gear.module_mm);
  text.about = fmt::format(
      "A gear pair of {} and {} teeth, module {} mm. ESTIMATE marks what nobody gave: put your own "
      "numbers there. Keys behind a # are others that a drawing may have.\n",
      gear.teeth[0], gear.teeth[1], gear.module_mm);
  text.keys[kTeeth.name] = {fmt::format("[{}, {}]", gear.teeth[0], gear.teeth[1]), ""};
  text.keys[kModule.name] = {fmt::format("{}", gear.module_mm), ""};
  const auto set = [&](const GearKey& key, const std::optional<double>& value) {
    if (value) text.keys[key.name] = {fmt::format("{}", *value), ""};
  };
  set(kFaceWidth, gear.face_width_mm);
  set(kHelix, gear.helix_angle_deg);
  set(kTorque, gear.torque_N_m);
  return gear_text(std::move(text), "the new gear pair");
}

}  // namespace gearsweep
