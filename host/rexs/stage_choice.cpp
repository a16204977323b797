#include "rexs/stage_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {
namespace {

// Whether two stages are meshes of one sun with planets that are alike.
bool are_alike(const GearUnit& unit, const UnitStage& a, const UnitStage& b) {
  if (a.planetary.empty() || a.planetary != b.planetary) return false;
  const auto same = [](const UnitGear& one, const UnitGear& other) {
    return one.teeth == other.teeth && one.module == other.module && one.shift == other.shift &&
           one.face_width == other.face_width && one.helix == other.helix;
  };
  return a.centre_distance == b.centre_distance &&
         same(unit.gears[*a.gears[0]], unit.gears[*b.gears[0]]) &&
         same(unit.gears[*a.gears[1]], unit.gears[*b.gears[1]]);
}

}  // namespace

std::string list_of_stages(const GearUnit& unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.stages.size(); ++i) {
    const UnitStage& stage = unit.stages[i];
    std::string teeth;
    if (stage.gears[0] && stage.gears[1]) {
      const auto a = unit.gears[*stage.gears[0]].teeth, b = unit.gears[*stage.gears[1]].teeth;
      if (a && b) teeth = fmt::format(", {:g}/{:g} teeth", *a, *b);
    }
    text += fmt::format("  {}: {}{}{}{}\n", i + 1, stage.name, teeth,
                        stage.refusal.empty() ? "" : "; no study: ", stage.refusal);
  }
  return text.empty() ? "  none\n" : text;
}

std::size_t chosen_stage(const GearUnit& unit, const std::string& text) {
  for (std::size_t i = 0; i < unit.stages.size() && !text.empty(); ++i) {
    if (text == std::to_string(i + 1) || text == unit.stages[i].name) return i;
  }
  if (!text.empty()) {
    throw InputError(fmt::format("{}: no stage '{}'; its stages, by number or name, are\n{}",
                                 unit.source, text, list_of_stages(unit)));
  }
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < unit.stages.size(); ++i) {
    if (unit.stages[i].refusal.empty()) usable.push_back(i);
  }
  const bool is_one =
      !usable.empty() && std::all_of(usable.begin() + 1, usable.end(), [&](std::size_t i) {
        return are_alike(unit, unit.stages[usable.front()], unit.stages[i]);
      });
  if (is_one) return usable.front();
  throw InputError(fmt::format(
      "{}: {}; its stages are\n{}", unit.source,
      usable.empty() ? "no study can be made of any stage" : "choose a stage, as in --stage 1",
      list_of_stages(unit)));
}

std::size_t chosen_case(const GearUnit& unit, std::size_t stage, const std::string& id) {
  std::vector<std::string> ids;
  std::size_t best = 0;
  for (std::size_t i = 0; i < unit.cases.size(); ++i) {
    if (!id.empty() && unit.cases[i].id == id) return i;
    ids.push_back(unit.cases[i].id);
    if (unit.cases[i].torques[stage].value_or(0.0) >
        unit.cases[best].torques[stage].value_or(0.0)) {
      best = i;
    }
  }
  if (id.empty()) return best;
  throw InputError(
      fmt::format("{}: no load case '{}'; there are: {}", unit.source, id, fmt::join(ids, ", ")));
}

}  // namespace gearsweep
