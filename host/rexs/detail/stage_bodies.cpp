#include "rexs/detail/stage_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gear/drawing_keys.hpp"

namespace gearsweep {

void add_bodies(const GearUnit& unit, const std::array<const UnitGear*, 2>& gears,
                StageDrawing* drawing) {
  const UnitShaft* shafts[2] = {};
  std::string bodies;
  for (std::size_t i = 0; i < 2; ++i) {
    if (gears[i]->shaft) shafts[i] = &unit.shafts[*gears[i]->shaft];
    if (shafts[i] == nullptr || !(shafts[i]->mass > 0.0)) {
      drawing->notes.push_back(
          fmt::format("{} is on no shaft of which the file has a body: discs stand for both gears",
                      gears[i]->name));
      return;
    }
    bodies += fmt::format("{}{}: {}", bodies.empty() ? "" : "; ", shafts[i]->name,
                          fmt::join(shafts[i]->bodies, ", "));
  }
  drawing->keys[kMass.name] = {fmt::format("[{:.6g}, {:.6g}]", shafts[0]->mass, shafts[1]->mass),
                               "ESTIMATE: of whole shafts with their gears. " + bodies};
  drawing->keys[kInertia.name] = {
      fmt::format("[{:.6g}, {:.6g}]", shafts[0]->inertia, shafts[1]->inertia),
      "ESTIMATE: of the same bodies"};
}

void add_bearings(const GearUnit& unit, const std::array<const UnitGear*, 2>& gears,
                  StageDrawing* drawing) {
  std::array<double, 2> sums = {};
  bool are_known = true;
  for (std::size_t i = 0; i < 2; ++i) {
    std::string names;
    for (const UnitBearing& one : unit.bearings) {
      const bool is_here =
          gears[i]->shaft && std::ranges::find(one.shafts, *gears[i]->shaft) != one.shafts.end();
      if (!is_here) continue;
      names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", one.name, one.kind);
      are_known = are_known && one.radial_stiffness.has_value();
      sums[i] += one.radial_stiffness.value_or(0.0);
    }
    are_known = are_known && sums[i] > 0.0;
    const char* const gear = i == 0 ? "pinion" : "gear";
    if (names.empty()) {
      drawing->bearing_notes.push_back(
          fmt::format("the file has no bearings of the {}: see bearing_stiffness_N_per_mm", gear));
    } else if (sums[i] == 0.0) {
      drawing->bearing_notes.push_back(
          fmt::format("bearings of the {}, without a stiffness that can be used: {}", gear, names));
    }
  }
  if (!are_known) return;
  drawing->keys[kBearingStiffness.name] = {
      fmt::format("[{0:.6g}, {0:.6g}, {1:.6g}, {1:.6g}]", sums[0], sums[1]),
      "from the file: the sum of radial_stiffness of each shaft's bearings"};
}

}  // namespace gearsweep
