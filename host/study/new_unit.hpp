// A study of three gears in a row, of two stages or of a planetary set, begun with their numbers of
// teeth.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gearsweep {

enum class GearArrangement { idler, two_stages, planetary };

struct NewUnit {
  GearArrangement arrangement = GearArrangement::idler;
  // Driver, idler, last gear; pinion and gear of either stage; sun, planet, ring.
  std::vector<int> teeth;
  // Of each mesh that has a drawing. The gears of an idler or a planetary set have one module and
  // one helix angle.
  std::array<double, 2> module_mm = {};
  std::array<std::optional<double>, 2> face_width_mm, helix_angle_deg;
  std::optional<double> torque_N_m;  // on the driver, the first pinion or the sun
};

// As new_gear_study(), for the model of the zoo that has these gears.
std::string new_unit_study(const NewUnit& unit);

}  // namespace gearsweep
