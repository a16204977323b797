#include "rexs/stage_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "rexs/detail/stage_bodies.hpp"
#include "rexs/detail/tip_relief.hpp"
#include "rexs/detail/tooth_play.hpp"

namespace gearsweep {
namespace {

constexpr const char* kFromFile = "from the file";

class StageDrawer {
 public:
  StageDrawer(const GearUnit& unit, std::size_t stage, std::size_t load_case, const StageView& view)
      : unit_(unit),
        index_(stage),
        stage_(unit.stages[stage]),
        case_(unit.cases[load_case]),
        meshes_(view.meshes) {
    if (!stage_.refusal.empty()) {
      throw InputError(fmt::format("{}: no study can be made of stage {} ({}): {}", unit.source,
                                   stage + 1, stage_.name, stage_.refusal));
    }
    gears_[0] = &unit.gears[*stage_.gears[0]];
    gears_[1] = &unit.gears[*stage_.gears[1]];
    is_swapped_ =
        view.first ? *view.first != *stage_.gears[0] : *gears_[0]->teeth > *gears_[1]->teeth;
    if (is_swapped_) std::swap(gears_[0], gears_[1]);
  }

  StageDrawing run() {
    read_teeth();
    read_centre();
    read_shifts();
    read_tips();
    read_width();
    add_bodies(unit_, gears_, &out_);
    add_bearings(unit_, gears_, &out_);
    read_backlash();
    read_materials();
    read_tip_relief();
    note_left_out();
    read_load();
    out_.contact_ratio = stage_.contact_ratio;
    out_.about = about();
    return std::move(out_);
  }

 private:
  void set(const GearKey& key, std::string value, std::string origin) {
    out_.keys[key.name] = {std::move(value), std::move(origin)};
  }
  void note(const std::string& text) { out_.notes.push_back(text); }

  static std::string pair(double a, double b) { return fmt::format("[{:.10g}, {:.10g}]", a, b); }

  void read_teeth() {
    for (std::size_t i = 0; i < 2; ++i) {
      const double teeth = *gears_[i]->teeth;
      if (teeth < kTeeth.min || teeth > kTeeth.max || teeth != std::floor(teeth)) {
        throw InputError(
            fmt::format("{}: {} has {:g} teeth; a whole number from {:g} to {:g} is "
                        "possible",
                        unit_.source, gears_[i]->name, teeth, kTeeth.min, kTeeth.max));
      }
      out_.teeth[i] = static_cast<int>(teeth);
    }
    set(kTeeth, fmt::format("[{}, {}]", out_.teeth[0], out_.teeth[1]),
        fmt::format("{}: {} and {}", kFromFile, gears_[0]->name, gears_[1]->name));
    out_.module = gears_[0]->module ? *gears_[0]->module : *gears_[1]->module;
    set(kModule, fmt::format("{:.10g}", out_.module), kFromFile);
    const auto helix = gears_[0]->helix ? gears_[0]->helix : gears_[1]->helix;
    helix_ = std::fabs(helix.value_or(0.0)) * kRad;
    if (helix_ > 0.0) set(kHelix, fmt::format("{:.10g}", helix_ / kRad), kFromFile);
    if (!helix) note("no helix_angle_reference_diameter: the teeth are taken as spur");
    if (gears_[0]->helix && gears_[1]->helix && *gears_[0]->helix * *gears_[1]->helix > 0.0) {
      note(
          fmt::format("both gears have the helix angle {:g} degrees, of one hand; outer teeth need "
                      "opposite hands, and have them here",
                      *gears_[0]->helix));
    }
    const auto alpha =
        gears_[0]->pressure_angle ? gears_[0]->pressure_angle : gears_[1]->pressure_angle;
    if (alpha) set(kPressureAngle, fmt::format("{:.10g}", *alpha), kFromFile);
    if (gears_[0]->pressure_angle && gears_[1]->pressure_angle &&
        std::fabs(*gears_[0]->pressure_angle - *gears_[1]->pressure_angle) > 1e-6) {
      throw InputError(fmt::format(
          "{}: the gears of stage {} have two pressure angles, {:g} and "
          "{:g} degrees",
          unit_.source, index_ + 1, *gears_[0]->pressure_angle, *gears_[1]->pressure_angle));
    }
    if (!alpha) note("no normal_pressure_angle: pressure_angle_deg is 20 by default");
    alpha_ = alpha.value_or(20.0) * kRad;
  }

  // From the file, or by the places of the shafts.
  void read_centre() {
    const auto stated = stage_.centre_distance, placed = stage_.axes_apart;
    centre_ = stated ? stated : placed;
    if (!centre_) return;
    set(kCentreDistance, fmt::format("{:.10g}", *centre_),
        stated ? kFromFile : "computed: from the places of both shafts");
    constexpr double kRounding = 0.01;  // mm
    if (stated && placed && std::fabs(*stated - *placed) > kRounding + 1e-4 * *stated) {
      note(fmt::format(
          "center_distance is {:g} mm, and the shafts stand {:g} mm apart: the first is "
          "taken",
          *stated, *placed));
    }
  }

  StageGeometry geometry() const {
    return {static_cast<double>(out_.teeth[0] + out_.teeth[1]),
            out_.module,
            helix_,
            alpha_,
            centre_.value_or(0.0),
            shifts_};
  }

  void read_shifts() {
    const auto a = gears_[0]->shift, b = gears_[1]->shift;
    std::optional<double> sum;
    if (centre_) sum = shifts_without_play(geometry());
    if (centre_ && !sum) {
      throw InputError(
          fmt::format("{}: center_distance of stage {}, {:g} mm, is smaller than its "
                      "base circles; is one of its numbers in another unit?",
                      unit_.source, index_ + 1, *centre_));
    }
    if (a && b) return set_shifts(*a, *b, kFromFile, sum);
    std::string by = "the centre distance";
    if (!sum && stage_.shift_sum) {
      sum = stage_.shift_sum;
      by = "their sum in the file";
    }
    if (!sum) {
      if (!centre_) {
        note("neither center_distance nor both shifts: without play of the tool's profile");
      }
      if (!a && !b) return;
      return set_shifts(a.value_or(0.0), b.value_or(0.0),
                        "ESTIMATE: one of them is not in the file, and has no shift here", {});
    }
    note("addendum_modification_coefficient of a flank is missing; see profile_shift");
    const double total = std::fabs(*sum) < 1e-9 ? 0.0 : *sum;
    if (!a && !b) {
      return set_shifts(0.5 * total, 0.5 * total,
                        fmt::format("ESTIMATE: the sum follows from {}, and is split evenly", by),
                        {});
    }
    set_shifts(a ? *a : total - *b, b ? *b : total - *a,
               fmt::format("computed: one from the file, the other from {}", by), {});
  }

  // sum: at which the teeth stand without play.
  void set_shifts(double a, double b, const std::string& origin, std::optional<double> sum) {
    shifts_ = a + b;
    set(kProfileShift, pair(a, b), origin);
    if (!sum || std::fabs(shifts_ - *sum) <= 0.02) return;
    note(fmt::format(
        "center_distance {:g} mm and the shifts disagree: without play it takes a sum of "
        "{:.4f}, and they have {:.4f}",
        *centre_, *sum, shifts_));
  }

  void read_tips() {
    if (gears_[0]->tip_diameter && gears_[1]->tip_diameter) {
      set(kTipDiameter, pair(*gears_[0]->tip_diameter, *gears_[1]->tip_diameter), kFromFile);
    } else if (gears_[0]->addendum && gears_[1]->addendum) {
      set(kAddendum, pair(*gears_[0]->addendum, *gears_[1]->addendum), kFromFile);
    } else {
      note("no tip_diameter of both gears: the addendum is one module by default");
    }
    const auto a = gears_[0]->dedendum, b = gears_[1]->dedendum;
    if (a && b && std::fabs(*a - *b) < 1e-6) {
      set(kDedendum, fmt::format("{:.10g}", *a), "from the file: the addendum of the tool");
    }
  }

  void read_width() {
    auto width = stage_.face_width;
    std::string origin = "from the file: common_face_width";
    if (!width && gears_[0]->face_width && gears_[1]->face_width) {
      width = std::min(*gears_[0]->face_width, *gears_[1]->face_width);
      origin = "from the file: the narrower gear";
    }
    if (!width && (gears_[0]->face_width || gears_[1]->face_width)) {
      width = gears_[0]->face_width ? gears_[0]->face_width : gears_[1]->face_width;
      origin = "ESTIMATE: that of the one gear of which the file has it";
    }
    if (!width || *width <= 0.0) return note("no face_width of both gears; ten modules are taken");
    out_.face_width = width;
    set(kFaceWidth, fmt::format("{:.10g}", *width), origin);
  }

  void read_backlash() {
    if (const auto play = tooth_play(stage_, gears_, geometry())) {
      set(kHalfBacklash, fmt::format("{:.6g}", 0.5 * play->along),
          play->origin + ", along the line of action");
    }
  }

  // Moduli that no material has stand for a rigid body.
  void read_materials() {
    constexpr double kSteel = 2.06e5, kSofter = 1e3, kStiffest = 1e6;  // N/mm^2
    constexpr double kAlike = 0.05;                                    // of kinds of steel
    double moduli[2] = {kSteel, kSteel};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto modulus = gears_[i]->modulus;
      if (!modulus) continue;
      if (*modulus < kSofter || *modulus > kStiffest) {
        note(fmt::format("elastic_modulus of {}, {:g} N/mm^2, is that of no gear: steel's is taken",
                         gears_[i]->name, *modulus));
        continue;
      }
      moduli[i] = *modulus;
    }
    const double both = 2.0 * moduli[0] * moduli[1] / (moduli[0] + moduli[1]);
    if (std::fabs(both / kSteel - 1.0) > kAlike) out_.stiffness_factor = both / kSteel;
  }

  // As a table over the path of contact, which begins on the gear's tip circle.
  void read_tip_relief() {
    if (!gears_[0]->tip_relief && !gears_[1]->tip_relief) return;
    const auto table = tip_relief_table(gears_, geometry());
    if (!table) {
      for (std::size_t i = 0; i < 2; ++i) {
        if (gears_[i]->tip_relief) left_out_[i].push_back(gears_[i]->tip_relief->label);
      }
      return;
    }
    const std::string name = "tip-relief.csv";
    set(kProfileFile, fmt::format("\"{}\"", name), "from the file: tip relief of both gears");
    out_.tables[name] = *table;
  }

  void note_left_out() {
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<std::string> all = left_out_[i];
      all.insert(all.end(), gears_[i]->left_out.begin(), gears_[i]->left_out.end());
      if (all.empty()) continue;
      note(
          fmt::format("not taken of {}: {}. See half_backlash_mm for the thickness of teeth, and "
                      "profile_deviation_file for changes of flanks",
                      gears_[i]->name, fmt::join(all, ", ")));
    }
  }

  // The torque of the first gear, turned to the pinion.
  std::optional<double> torque_of(const UnitCase& one) const {
    const auto torque = one.torques[index_];
    if (!torque) return torque;
    return *torque * meshes_ *
           (is_swapped_ ? out_.teeth[0] / static_cast<double>(out_.teeth[1]) : 1.0);
  }
  std::optional<double> speed_of(const UnitCase& one) const {
    const auto speed = one.speeds[index_];
    if (!speed || !is_swapped_) return speed;
    return *speed * out_.teeth[1] / out_.teeth[0];
  }

  void read_load() {
    const char* share = stage_.planetary.empty() ? ""
                        : meshes_ > 1            ? ", on the sun"
                                                 : ", shared evenly by the planets";
    if (const auto torque = torque_of(case_)) {
      set(kTorque, fmt::format("{:.6g}", *torque),
          case_.id.empty()
              ? fmt::format("from the file's loads{}", share)
              : fmt::format("from the file: load case {}{}, without losses", case_.id, share));
    } else {
      note("the torque on this mesh follows from no external_load of the file");
    }
    for (const UnitCase& one : unit_.cases) {
      const auto speed = speed_of(one);
      out_.fastest = std::max(out_.fastest, speed.value_or(0.0));
      out_.cases.push_back({one.id, torque_of(one), speed, one.share});
    }
    if (out_.fastest == 0.0) {
      note(
          "the speed of this mesh follows from no rotational_speed of the file: the study goes up "
          "to the resonance of the teeth");
    }
  }

  std::string about() const {
    std::string text = fmt::format("Stage {} of {}: {}.\n", index_ + 1, unit_.source, stage_.name);
    if (!stage_.planetary.empty()) {
      text +=
          "Of a planetary stage: one mesh of sun and planet alone. Speeds are relative to the "
          "carrier.\n";
    }
    if (is_swapped_) text += "The pinion is the second gear of the stage in the file.\n";
    if (stage_.contact_ratio) {
      text +=
          fmt::format("The file has the transverse contact ratio {:.4g}.\n", *stage_.contact_ratio);
    }
    return text;
  }

  static constexpr double kRad = std::numbers::pi / 180.0;
  const GearUnit& unit_;
  std::size_t index_;
  const UnitStage& stage_;
  const UnitCase& case_;
  std::array<const UnitGear*, 2> gears_ = {};
  int meshes_ = 1;
  bool is_swapped_ = false;
  double helix_ = 0.0, alpha_ = 0.0;  // rad
  double shifts_ = 0.0;               // their sum
  std::optional<double> centre_;
  std::array<std::vector<std::string>, 2> left_out_;  // of both gears
  StageDrawing out_;
};

}  // namespace

std::string text_of(const std::vector<DrawnLoad>& cases) {
  std::string text;
  for (const DrawnLoad& one : cases) {
    if (!one.torque && !one.speed) continue;
    text += fmt::format("{}:{}{}{}\n",
                        one.id.empty() ? "Its loads" : fmt::format("Load case {}", one.id),
                        one.torque ? fmt::format(" torque_N_m = {:.6g}", *one.torque) : "",
                        one.speed ? fmt::format(" at pinion_speed_rpm = {:.6g}", *one.speed) : "",
                        one.share ? fmt::format(", {:.4g} % of the time", 100.0 * *one.share) : "");
  }
  return text;
}

StageDrawing stage_drawing(const GearUnit& unit, std::size_t stage, std::size_t load_case,
                           const StageView& view) {
  return StageDrawer(unit, stage, load_case, view).run();
}

}  // namespace gearsweep
