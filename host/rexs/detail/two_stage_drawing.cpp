#include "rexs/detail/two_stage_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "gear/drawing_keys.hpp"
#include "rexs/stage_choice.hpp"

namespace gearsweep {
namespace {

// Where a stage stands in the unit, and its gears in the order of the power.
struct PlacedStage {
  std::size_t stage = 0;
  std::size_t in = 0, out = 0;              // gears
  std::size_t in_shaft = 0, out_shaft = 0;  // their shafts
};

PlacedStage turned(const PlacedStage& one) {
  return {one.stage, one.out, one.in, one.out_shaft, one.in_shaft};
}

class TwoStages {
 public:
  TwoStages(const GearUnit& unit, const std::string& load_case) : unit_(unit) {
    place();
    case_ = chosen_case(unit, first_.stage, load_case);
  }

  UnitDrawing run() {
    out_.model = "two_stages";
    out_.summary = fmt::format("{:g}/{:g} and {:g}/{:g} teeth", teeth(first_.in), teeth(first_.out),
                               teeth(second_.in), teeth(second_.out));
    StageDrawing first = stage_drawing(unit_, first_.stage, case_, {first_.in, 1});
    StageDrawing second = stage_drawing(unit_, second_.stage, case_, {second_.in, 1});
    split_inertia(&first, &second);
    choose_shaft();
    tell_phase();
    describe();
    out_.about += text_of(first.cases);
    out_.drawings.emplace_back("first", std::move(first));
    out_.drawings.emplace_back("second", std::move(second));
    note_other_shafts();
    return std::move(out_);
  }

 private:
  double teeth(std::size_t gear) const { return *unit_.gears[gear].teeth; }
  const UnitShaft& middle() const { return unit_.shafts[first_.out_shaft]; }

  PlacedStage placed(std::size_t index) const {
    const UnitStage& stage = unit_.stages[index];
    if (!stage.refusal.empty()) {
      throw NoArrangement(fmt::format("stage {} becomes none: {}", index + 1, stage.refusal));
    }
    PlacedStage out = {index, *stage.gears[0], *stage.gears[1], 0, 0};
    for (const auto& [gear, shaft] :
         {std::pair(out.in, &out.in_shaft), std::pair(out.out, &out.out_shaft)}) {
      if (!unit_.gears[gear].shaft) {
        throw NoArrangement(fmt::format("{} is on no shaft", unit_.gears[gear].name));
      }
      *shaft = *unit_.gears[gear].shaft;
    }
    if (out.in_shaft == out.out_shaft) {
      throw NoArrangement(fmt::format("both gears of stage {} are on one shaft", index + 1));
    }
    return out;
  }

  // Both stages in the order of the power.
  void place() {
    const std::size_t count = unit_.stages.size();
    if (count != 2) {
      throw NoArrangement(fmt::format("it has {} stage{}, and the model two_stages has two", count,
                                      count == 1 ? "" : "s"));
    }
    PlacedStage a = placed(0), b = placed(1);
    for (const std::size_t gear : {a.in, a.out}) {
      if (gear == b.in || gear == b.out) {
        throw NoArrangement(
            fmt::format("{} is in both stages: it is an idler, for which there is the model idler",
                        unit_.gears[gear].name));
      }
    }
    const std::set<std::size_t> of_a = {a.in_shaft, a.out_shaft};
    const auto shared = of_a.count(b.in_shaft) + of_a.count(b.out_shaft);
    if (shared == 0) throw NoArrangement("its stages share no shaft");
    if (shared == 2) {
      throw NoArrangement(
          "its stages stand between the same two shafts: one of them idles, or the "
          "power splits");
    }
    if (of_a.contains(b.out_shaft)) b = turned(b);
    if (a.in_shaft == b.in_shaft) a = turned(a);
    // Now a hands on to b.
    if (is_driven_from_b(a, b)) {
      std::swap(a, b);
      a = turned(a);
      b = turned(b);
    }
    first_ = a;
    second_ = b;
  }

  // By what the file says of driving gears; else a unit reduces the speed.
  bool is_driven_from_b(const PlacedStage& a, const PlacedStage& b) {
    for (const PlacedStage& one : {a, b}) {
      const UnitStage& stage = unit_.stages[one.stage];
      if (stage.driver) return *stage.gears[*stage.driver] != one.in;
    }
    const double ratio = teeth(a.out) / teeth(a.in) * teeth(b.out) / teeth(b.in);
    if (ratio != 1.0) {
      out_.notes.push_back(
          fmt::format("the file does not say which shaft drives: {} does here, which turns faster",
                      unit_.shafts[ratio > 1.0 ? a.in_shaft : b.out_shaft].name));
    }
    return ratio < 1.0;
  }

  static std::string pair(double a, double b) { return fmt::format("[{:.6g}, {:.6g}]", a, b); }

  // The middle shaft turns with a gear of each drawing, which has half of what is no gear of the
  // two.
  void split_inertia(StageDrawing* first, StageDrawing* second) {
    const UnitGear& gear = unit_.gears[first_.out];
    const UnitGear& pinion = unit_.gears[second_.in];
    const double rest = 0.5 * (middle().inertia - gear.inertia - pinion.inertia);
    const double of_gear = gear.inertia + rest, of_pinion = pinion.inertia + rest;
    const double in = unit_.shafts[first_.in_shaft].inertia;
    const double out = unit_.shafts[second_.out_shaft].inertia;
    if (!first->keys.contains(kInertia.name) || !second->keys.contains(kInertia.name) ||
        !(of_gear > 0.0 && of_pinion > 0.0 && in > 0.0 && out > 0.0)) {
      for (StageDrawing* one : {first, second}) {
        one->keys.erase(kInertia.name);
        one->keys.erase(kMass.name);
      }
      return;
    }
    first->keys[kInertia.name] = {
        pair(in, of_gear),
        fmt::format("ESTIMATE: of {} with all on it, and of {} with half of the rest of {}, {:.6g}",
                    unit_.shafts[first_.in_shaft].name, gear.name, middle().name, rest)};
    second->keys[kInertia.name] = {
        pair(of_pinion, out),
        fmt::format("ESTIMATE: of {} with the other half of {}, and of {} with all on it",
                    pinion.name, middle().name, unit_.shafts[second_.out_shaft].name)};
  }

  void choose_shaft() {
    const auto from = unit_.gears[first_.out].place, to = unit_.gears[second_.in].place;
    std::optional<double> stiffness;
    if (from && to) stiffness = torsional_stiffness(middle(), *from, *to);
    out_.options = {{"shaft", stiffness ? "elastic" : "rigid"}};
    if (!stiffness) {
      out_.notes.push_back(
          fmt::format("{} is rigid here: its sections do not reach from gear to gear; shaft = "
                      "\"elastic\" in [model] takes k_shaft, its stiffness",
                      middle().name));
      return;
    }
    out_.parameters.push_back(
        {"k_shaft", fmt::format("{:.6g}", *stiffness),
         fmt::format(
             "torsional stiffness of {} in N m/rad; computed: of its sections over the {:g} "
             "mm between the middles of its gears, with the shear modulus {}",
             middle().name, std::fabs(*to - *from),
             middle().shear_modulus ? "of its material" : "of steel")});
  }

  // A file has no angle between the teeth of two gears. In a turn of their shaft the second mesh
  // goes through z_pinion periods while the first goes through z_gear: where each begins in the
  // other's are all multiples of gcd/z_gear, so that only the remainder of the phase by it makes
  // another motion.
  void tell_phase() {
    const int gear = static_cast<int>(teeth(first_.out)),
              pinion = static_cast<int>(teeth(second_.in));
    const int meetings = gear / std::gcd(gear, pinion);
    constexpr int kMany = 10;
    const std::string counts =
        meetings == 1 ? "all of it counts: sweep it from 0 to 1"
                      : fmt::format(
                            "values that differ by 1/{} make the same motion, for in a turn "
                            "of {} the meshes meet in {} phases{}",
                            meetings, middle().name, meetings,
                            meetings < kMany ? fmt::format(": sweep it from 0 to 1/{}", meetings)
                                             : ", so that it hardly counts");
    out_.parameters.push_back(
        {"shift", "0",
         "by how much of its mesh period the second mesh is ahead; ASSUMED: the file has no angle "
         "between the teeth of both gears on one shaft. Of perfect teeth " +
             counts,
         true});
    out_.notes.push_back(
        fmt::format("the phase between the meshes, shift, is 0 here: the file has "
                    "no angle between the teeth of {} and {}. Of perfect teeth {}",
                    unit_.gears[first_.out].name, unit_.gears[second_.in].name, counts));
  }

  void describe() {
    out_.about = fmt::format(
        "The whole unit: {} drives {}, and that {}. The stages are {} and {} of the file.\n",
        unit_.shafts[first_.in_shaft].name, middle().name, unit_.shafts[second_.out_shaft].name,
        first_.stage + 1, second_.stage + 1);
    out_.about += "The torque of [gear.first] is the load of both meshes.\n";
  }

  void note_other_shafts() {
    for (std::size_t i = 0; i < unit_.shafts.size(); ++i) {
      if (i == first_.in_shaft || i == first_.out_shaft || i == second_.out_shaft) continue;
      out_.notes.push_back(
          fmt::format("{} is no part of the model: its inertia is left out", unit_.shafts[i].name));
    }
  }

  const GearUnit& unit_;
  PlacedStage first_, second_;
  std::size_t case_ = 0;
  UnitDrawing out_;
};

}  // namespace

UnitDrawing two_stage_drawing(const GearUnit& unit, const std::string& load_case) {
  return TwoStages(unit, load_case).run();
}

}  // namespace gearsweep
