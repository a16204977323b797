// Gear units of strangers.
#include "fuzz/targets.hpp"
#include "model/error.hpp"
#include "rexs/gear_unit.hpp"
#include "rexs/stage_choice.hpp"
#include "rexs/stage_drawing.hpp"
#include "study/imported_gear.hpp"

namespace gearsweep::testing {

void read_hostile_rexs(const std::string& bytes) {
  try {
    const GearUnit unit = gear_unit_of(read_rexs(bytes, "unit.rexs"));
    for (std::size_t i = 0; i < unit.stages.size() && i < 3; ++i) {
      try {
        imported_gear_study(stage_drawing(unit, i, chosen_case(unit, i, "")), "unit.rexs");
      } catch (const InputError&) {
        continue;
      }
    }
    imported_unit_study(unit_drawing(unit, ""), "unit.rexs");
  } catch (const InputError&) {
    return;
  }
}

}  // namespace gearsweep::testing
