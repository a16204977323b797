#include "rexs/unit_drawing.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "rexs/detail/planetary_drawing.hpp"
#include "rexs/detail/two_stage_drawing.hpp"
#include "rexs/stage_choice.hpp"

namespace gearsweep {
namespace {

// Throws InputError with what can be done instead.
[[noreturn]] void refuse(const GearUnit& unit, const std::string& why) {
  std::string first = "1";
  for (std::size_t i = unit.stages.size(); i-- > 0;) {
    if (unit.stages[i].refusal.empty()) first = std::to_string(i + 1);
  }
  throw InputError(
      fmt::format("{}: the whole unit becomes no study: {}. Its stages are\n{}Make a study of each "
                  "that can be one, as in --stage {} -o stage{}.toml; 'gearsweep models' lists "
                  "arrangements whose drawings you can write by hand",
                  unit.source, why, list_of_stages(unit), first, first));
}

}  // namespace

UnitDrawing unit_drawing(const GearUnit& unit, const std::string& load_case) {
  try {
    if (unit.planetaries.empty()) return two_stage_drawing(unit, load_case);
    return planetary_drawing(unit, load_case);
  } catch (const NoArrangement& why) {
    refuse(unit, why.what());
  }
}

}  // namespace gearsweep
