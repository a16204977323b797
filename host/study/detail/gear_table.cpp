#include "study/detail/gear_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "study/builtin_models.hpp"
#include "study/detail/gear_files.hpp"
#include "study/detail/gear_keys.hpp"

namespace gearsweep {
namespace {

// Collects the parameters; each is checked against the range that the model gives it.
class Parameters {
 public:
  explicit Parameters(const GearReader& in) : in_(in), model_(gear_table_model()) {}

  // `origin`: the key that a message about this number should point at.
  void add(std::string_view name, double value, const GearKey& origin, std::string note) {
    const auto index = static_cast<std::size_t>(model_.find_parameter(name));
    const ParameterInfo& info = model_.parameters[index];
    if (!(value >= info.min && value <= info.max)) {
      fail_at(
          in_.node(origin),
          fmt::format("{} gives {} = {:.6g}, out of range; from {:g} to {:g} is allowed ({}: {})",
                      in_.has(origin) ? origin.name : "[gear]", name, value, info.min, info.max,
                      info.meaning, note));
    }
    list_.push_back({std::string(name), value, std::move(note), std::string(origin.name)});
  }

  std::vector<GearParameter> take() { return std::move(list_); }

 private:
  const GearReader& in_;
  const Model& model_;
  std::vector<GearParameter> list_;
};

// Lengths in mm, angle in rad.
struct Geometry {
  double pinion_teeth, gear_teeth, module;
  double pinion_base, gear_base;  // base radii Rp, Rg
  double alpha;                   // working pressure angle
  double centre;                  // centre distance
  double base_pitch;              // transverse, as all of these but the module
  double helix;                   // at the reference circle
  std::vector<double> shift;      // profile shift coefficients
  // Reference radii.
  double reference(double teeth) const { return module / std::cos(helix) * teeth / 2.0; }
};

void read_teeth(GearReader& in, Geometry* out) {
  const std::vector<double> teeth = in.list(kTeeth, 2);
  if (!in.node(kTeeth).is_array() || std::floor(teeth[0]) != teeth[0] ||
      std::floor(teeth[1]) != teeth[1]) {
    fail_at(in.node(kTeeth), "teeth must be two whole numbers, [pinion, gear]");
  }
  out->pinion_teeth = teeth[0];
  out->gear_teeth = teeth[1];
}

double involute(double angle) { return std::tan(angle) - angle; }

// By Newton's method, from where it converges from above.
double angle_of_involute(double wanted) {
  double angle = std::fmin(std::cbrt(3.0 * wanted), 1.5);
  for (int i = 0; i < 50; ++i) {
    const double tangent = std::tan(angle);
    angle -= (tangent - angle - wanted) / (tangent * tangent);
  }
  return angle;
}

// Within a part in a million of the standard centre distance the tool's pressure angle is kept, so
// that a rounded drawing gives the same gear as no centre distance at all.
Geometry read_geometry(GearReader& in) {
  Geometry out{};
  read_teeth(in, &out);
  out.module = in.required(kModule);
  out.helix = in.optional(kHelix).value_or(0.0) * std::numbers::pi / 180.0;
  out.shift = in.pair_or_zero(kProfileShift);
  const double normal_alpha = in.optional(kPressureAngle).value_or(20.0) * std::numbers::pi / 180.0;
  const double tool_alpha =
      out.helix == 0.0 ? normal_alpha : std::atan(std::tan(normal_alpha) / std::cos(out.helix));
  out.pinion_base = out.reference(out.pinion_teeth) * std::cos(tool_alpha);
  out.gear_base = out.reference(out.gear_teeth) * std::cos(tool_alpha);
  out.base_pitch = 2.0 * std::numbers::pi * out.pinion_base / out.pinion_teeth;
  const double teeth = out.pinion_teeth + out.gear_teeth;
  const double standard = out.reference(teeth);
  const double shifts = out.shift[0] + out.shift[1];
  if (shifts != 0.0 && !in.has(kCentreDistance)) {
    // Without backlash of the tool's profile: inv(alpha_w) = inv(alpha_t) + 2 tan(alpha_n) x/z.
    const double wanted = involute(tool_alpha) + 2.0 * std::tan(normal_alpha) * shifts / teeth;
    if (wanted <= 0.0) {
      fail_at(in.node(kProfileShift), "profile_shift brings the gears too near: no pressure angle");
    }
    out.alpha = angle_of_involute(wanted);
    out.centre = (out.pinion_base + out.gear_base) / std::cos(out.alpha);
    return out;
  }
  out.centre = in.optional(kCentreDistance).value_or(standard);
  out.alpha = tool_alpha;
  if (std::fabs(out.centre - standard) > 1e-6 * standard) {
    const double touching = out.pinion_base + out.gear_base;
    if (out.centre <= touching) {
      fail_at(in.node(kCentreDistance),
              fmt::format("centre_distance_mm = {} is not greater than the sum of the base radii, "
                          "{:.6g} mm: there is no line of action (standard: {:.6g} mm)",
                          out.centre, touching, standard));
    }
    out.alpha = std::acos(touching / out.centre);
  }
  return out;
}

// The path of contact on the line of action, in base pitches: from entry to the pitch point and on
// to exit.
struct Path {
  double approach, recess;
  double contact_ratio() const { return approach + recess; }
};

// Contact begins on the gear's addendum circle and ends on the pinion's.
Path path_from_tips(const Geometry& geometry, const std::vector<double>& tips) {
  const auto reach = [&](double tip, double base) {
    return (std::sqrt(tip * tip - base * base) - base * std::tan(geometry.alpha)) /
           geometry.base_pitch;
  };
  return {reach(tips[1], geometry.gear_base), reach(tips[0], geometry.pinion_base)};
}

// Radii of the tip circles.
std::vector<double> read_tips(GearReader& in, const Geometry& geometry) {
  if (in.has(kTipDiameter) && in.has(kAddendum)) {
    fail_at(in.node(kTipDiameter), "tip_diameter_mm and addendum_mm both give the tips; keep one");
  }
  if (in.has(kTipDiameter)) {
    std::vector<double> tips = in.list(kTipDiameter, 2);
    for (double& tip : tips) tip /= 2.0;
    return tips;
  }
  const std::vector<double> addenda =
      in.has(kAddendum) ? in.list(kAddendum, 2) : std::vector<double>(2, geometry.module);
  return {
      geometry.reference(geometry.pinion_teeth) + addenda[0] + geometry.shift[0] * geometry.module,
      geometry.reference(geometry.gear_teeth) + addenda[1] + geometry.shift[1] * geometry.module};
}

// Involutes meet only between the two points where the line of action touches the base circles.
void refuse_interference(const GearReader& in, const Geometry& geometry, const Path& path) {
  const auto check = [&](double share, double base, const char* whose) {
    const double beyond = share * geometry.base_pitch - base * std::tan(geometry.alpha);
    if (beyond > 1e-9 * base) {
      const GearKey& origin = in.has(kContactRatio)  ? kContactRatio
                              : in.has(kTipDiameter) ? kTipDiameter
                                                     : kAddendum;
      fail_at(
          in.node(origin),
          fmt::format("the path of contact reaches {:.3g} mm beyond the point where the line of "
                      "action touches the {}'s base circle (interference); a smaller "
                      "addendum_mm or contact_ratio is needed",
                      beyond, whose));
    }
  };
  check(path.approach, geometry.pinion_base, "pinion");
  check(path.recess, geometry.gear_base, "gear");
}

// Adds eps and approach; returns the path of contact in use.
Path read_path(GearReader& in, const Geometry& geometry, Parameters* parameters,
               std::vector<std::string>* notes) {
  const std::vector<double> tips = read_tips(in, geometry);
  const std::vector<double> addenda = {tips[0] - geometry.reference(geometry.pinion_teeth),
                                       tips[1] - geometry.reference(geometry.gear_teeth)};
  const GearKey& drawing = in.has(kAddendum)       ? kAddendum
                           : in.has(kTipDiameter)  ? kTipDiameter
                           : in.has(kProfileShift) ? kProfileShift
                                                   : kCentreDistance;
  const Path drawn = path_from_tips(geometry, tips);
  if (!(drawn.approach > 0.0 && drawn.recess > 0.0)) {
    fail_at(in.node(drawing),
            fmt::format("the addenda ({:.6g} and {:.6g} mm) do not reach over the pitch point "
                        "at centre_distance_mm = {:.6g}",
                        addenda[0], addenda[1], geometry.centre));
  }
  const double from_geometry = drawn.contact_ratio();
  const std::optional<double> given = in.optional(kContactRatio);
  const double eps = given.value_or(from_geometry);
  const double approach = drawn.approach / from_geometry;
  const std::string formula =
      fmt::format("addenda {:.6g} and {:.6g} mm: eps_a + eps_r = {:.6g} + {:.6g} = {:.6g}",
                  addenda[0], addenda[1], drawn.approach, drawn.recess, from_geometry);
  notes->push_back(given ? fmt::format("contact ratio {:.6g} as given ({})", eps, formula)
                         : fmt::format("contact ratio {:.6g} from {}", eps, formula));
  parameters->add("eps", eps, given ? kContactRatio : drawing,
                  given ? "contact_ratio as given" : formula);
  parameters->add(
      "approach", approach, drawing,
      fmt::format("eps_a/(eps_a + eps_r) = {:.6g} / {:.6g}", drawn.approach, from_geometry));
  const Path used{approach * eps, (1.0 - approach) * eps};
  refuse_interference(in, geometry, used);
  return used;
}

// Mean mesh stiffness k0 in N/m, as given or from the face width: ISO 6336-1, method B, for steel
// (theoretical single stiffness 1/q', model factor 0.8, basic rack factor 0.975, helix factor
// cos(beta)). Without either, the mean of what was measured, if that is above 0.
double read_mesh_stiffness(GearReader& in, const Geometry& geometry, double contact_ratio,
                           double measured, std::vector<std::string>* notes) {
  if (in.has(kMeshStiffness) && in.has(kFaceWidth) && geometry.helix == 0.0) {
    fail_at(in.node(kFaceWidth),
            "mesh_stiffness_N_per_m and face_width_mm both give the mesh stiffness; keep one");
  }
  if (in.has(kMeshStiffness)) {
    const double k0 = in.required(kMeshStiffness);
    notes->push_back(fmt::format("mean mesh stiffness k0 = {:.6g} N/m as given", k0));
    return k0;
  }
  if (measured > 0.0) {
    notes->push_back(fmt::format("mean mesh stiffness k0 = {:.6g} N/m as measured", measured));
    return measured;
  }
  if (!in.has(kFaceWidth)) {
    fail_at(in.node(kFaceWidth),
            "[gear] needs 'mesh_stiffness_N_per_m' (mean mesh stiffness) or 'face_width_mm'");
  }
  const double width = in.required(kFaceWidth);
  const double slant = std::cos(geometry.helix);
  const double z1 = geometry.pinion_teeth / (slant * slant * slant);
  const double z2 = geometry.gear_teeth / (slant * slant * slant);
  const double x1 = geometry.shift[0], x2 = geometry.shift[1];
  const double q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1 -
                   0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1 * x1 + 0.00182 * x2 * x2;
  const double single = 0.8 * 0.975 / q * slant;
  const double mesh = single * (0.75 * contact_ratio + 0.25);
  const double k0 = mesh * width * 1e6;
  notes->push_back(fmt::format(
      "mean mesh stiffness k0 = {:.6g} N/m from ISO 6336-1 method B (steel): "
      "q' = {:.6g} um mm/N, c' = {:.6g}, c_gamma = {:.6g} N/(um mm), face width {:.6g} mm",
      k0, q, single, mesh, width));
  return k0;
}

// What the equations of motion are scaled by; SI units.
struct Bases {
  double pinion_mesh_mass, gear_mesh_mass;  // I/R^2, kg
  double me;                                // kg
  double k0;                                // N/m
  double b_n;                               // m
  double varpi;                             // rad/s
  double pinion_base;                       // Rp, m
};

Bases read_bases(GearReader& in, const Geometry& geometry, double contact_ratio,
                 double measured_stiffness, std::vector<std::string>* notes) {
  const std::vector<double> inertia = in.list(kInertia, 2);
  Bases out{};
  out.pinion_mesh_mass = inertia[0] / (geometry.pinion_base * geometry.pinion_base);
  out.gear_mesh_mass = inertia[1] / (geometry.gear_base * geometry.gear_base);
  out.me = out.pinion_mesh_mass * out.gear_mesh_mass / (out.pinion_mesh_mass + out.gear_mesh_mass);
  notes->push_back(
      fmt::format("me = {:.6g} kg from 1/me = Rp^2/Ip + Rg^2/Ig, Ip/Rp^2 = {:.6g} kg, "
                  "Ig/Rg^2 = {:.6g} kg",
                  out.me, out.pinion_mesh_mass, out.gear_mesh_mass));
  out.k0 = read_mesh_stiffness(in, geometry, contact_ratio, measured_stiffness, notes);
  out.b_n = in.required(kHalfBacklash) * 1e-3;
  out.varpi = std::sqrt(out.k0 / out.me);
  out.pinion_base = geometry.pinion_base * 1e-3;
  notes->push_back(fmt::format("varpi = sqrt(k0/me) = {:.6g} rad/s", out.varpi));
  return out;
}

void add_geometry(GearReader& in, const Geometry& geometry, Parameters* parameters,
                  std::vector<std::string>* notes) {
  const double degrees = geometry.alpha * 180.0 / std::numbers::pi;
  notes->push_back(
      fmt::format("base radii Rp = {:.7g} mm, Rg = {:.7g} mm (module z/2 cos(alpha)); "
                  "base pitch {:.7g} mm",
                  geometry.pinion_base, geometry.gear_base, geometry.base_pitch));
  notes->push_back(fmt::format("working pressure angle {:.6g} degrees at centre distance {:.6g} mm",
                               degrees, geometry.centre));
  parameters->add("zp", geometry.pinion_teeth, kTeeth, "teeth of the pinion as given");
  parameters->add("teeth_ratio", geometry.gear_teeth / geometry.pinion_teeth, kTeeth,
                  fmt::format("zg/zp = {} / {}", geometry.gear_teeth, geometry.pinion_teeth));
  if (geometry.helix > 0.0) {
    const double width = in.required(kFaceWidth);
    const double overlap = width * std::sin(geometry.helix) / (std::numbers::pi * geometry.module);
    parameters->add(
        "overlap", overlap, kHelix,
        fmt::format("b sin(beta)/(pi m) = {:.6g} mm / {:.6g} mm", width * std::sin(geometry.helix),
                    std::numbers::pi * geometry.module));
    notes->push_back(
        "helical teeth: radii, pressure angle, torque's force and backlash are those "
        "of the transverse section; axial forces are left out");
  }
  const GearKey& origin = in.has(kCentreDistance) ? kCentreDistance : kPressureAngle;
  parameters->add("alpha", degrees, origin,
                  fmt::format("working pressure angle at a = {:.6g} mm", geometry.centre));
}

void add_masses(GearReader& in, const Bases& bases, Parameters* parameters) {
  const double sum = bases.pinion_mesh_mass + bases.gear_mesh_mass;
  parameters->add(
      "rho_p", bases.gear_mesh_mass / sum, kInertia,
      fmt::format("me/(Ip/Rp^2) = {:.6g} kg / {:.6g} kg", bases.me, bases.pinion_mesh_mass));
  parameters->add(
      "rho_g", bases.pinion_mesh_mass / sum, kInertia,
      fmt::format("me/(Ig/Rg^2) = {:.6g} kg / {:.6g} kg", bases.me, bases.gear_mesh_mass));
  const std::vector<double> mass = in.list(kMass, 2);
  parameters->add("m1", bases.me / mass[0], kMass,
                  fmt::format("me/mp = {:.6g} kg / {:.6g} kg", bases.me, mass[0]));
  parameters->add("m2", bases.me / mass[1], kMass,
                  fmt::format("me/mg = {:.6g} kg / {:.6g} kg", bases.me, mass[1]));
}

void add_springs_and_dampers(GearReader& in, const Bases& bases, Parameters* parameters) {
  const double cm = in.required(kMeshDamping) * 1e3;
  parameters->add("zeta", cm / (2.0 * bases.varpi * bases.me), kMeshDamping,
                  fmt::format("cm/(2 varpi me) = {:.6g} N s/m / (2 {:.6g} rad/s {:.6g} kg)", cm,
                              bases.varpi, bases.me));
  const std::vector<double> stiffness = in.list(kBearingStiffness, 4);
  const std::vector<double> damping = in.list(kBearingDamping, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const double spring = stiffness[i] * 1e3;
    parameters->add(fmt::format("k{}", i + 1), spring / bases.k0, kBearingStiffness,
                    fmt::format("K{}/k0 = {:.6g} N/m / {:.6g} N/m", i + 1, spring, bases.k0));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const double damper = damping[i] * 1e3;
    if (cm == 0.0 && damper > 0.0) {
      fail_at(in.node(kMeshDamping),
              "mesh_damping_N_s_per_mm = 0 with bearing damping: gear5 counts bearing damping in "
              "mesh damping (c = C/cm); give a positive number, or no damping at all");
    }
    parameters->add(fmt::format("c{}", i + 1), cm == 0.0 ? 0.0 : damper / cm, kBearingDamping,
                    fmt::format("C{}/cm = {:.6g} N s/m / {:.6g} N s/m", i + 1, damper, cm));
  }
}

void add_lengths_and_loads(GearReader& in, const Geometry& geometry, const Bases& bases,
                           Parameters* parameters) {
  const double centre = geometry.centre * 1e-3;
  parameters->add("b", 1.0, kHalfBacklash, "the half backlash b_n is the unit of length");
  parameters->add("A", centre / bases.b_n, kHalfBacklash,
                  fmt::format("a/b_n = {:.6g} m / {:.6g} m", centre, bases.b_n));
  const double torque = in.required(kTorque);
  parameters->add("F1", torque / (bases.pinion_base * bases.k0 * bases.b_n), kTorque,
                  fmt::format("T/(Rp k0 b_n) = {:.6g} N m / ({:.6g} m {:.6g} N/m {:.6g} m)", torque,
                              bases.pinion_base, bases.k0, bases.b_n));
}

std::string name_in_list(const std::string& name, std::size_t place) {
  return place == 0 ? name : fmt::format("{}_{}", name, place + 1);
}

constexpr std::size_t kMostHarmonics = 8;

// The mean square of what is not the mean.
double power_of(const MeasuredCurve& curve) {
  constexpr int kSamples = 4096;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSamples;
    sum += std::pow(curve.table->at(angle, angle) - curve.mean, 2) / kSamples;
  }
  return sum;
}

// Of a measured error. A second derivative enters: a curve that jumps has none.
void add_measured_error(GearReader& in, const MeasuredCurve& curve, const Bases& bases,
                        Parameters* parameters, std::vector<std::string>* notes) {
  if (in.has(kTransmissionError) || in.has(kErrorPhase)) {
    fail_at(in.node(kErrorFile),
            "transmission_error_file and transmission_error_um both give the error; keep one");
  }
  if (!curve.table->jumps().empty()) {
    fail_at(in.node(kErrorFile), "a transmission error that jumps has no second derivative");
  }
  const std::vector<Harmonic> harmonics = harmonics_of(*curve.table, kMostHarmonics);
  const double all = power_of(curve);
  double left = all;
  for (const Harmonic& harmonic : harmonics) left -= 0.5 * harmonic.amplitude * harmonic.amplitude;
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const double error = harmonics[i].amplitude * 1e-6;
    const std::string note = fmt::format("harmonic {} of the measured error", i + 1);
    parameters->add(name_in_list("e0", i), error / bases.b_n, kErrorFile, note);
    parameters->add(name_in_list("e0_phase", i), harmonics[i].phase, kErrorFile, note);
  }
  notes->push_back(fmt::format(
      "transmission error: the first {} harmonics of '{}'; they leave out {:.3g} % of its power",
      harmonics.size(), curve.table->name(), all > 0.0 ? 100.0 * std::fmax(0.0, left) / all : 0.0));
}

// Returns whether one sine is enough.
bool add_transmission_error(GearReader& in, const Bases& bases, Parameters* parameters,
                            std::vector<std::string>* notes) {
  if (const auto curve = measured_curve(in, kErrorFile, Interpolation::cubic)) {
    add_measured_error(in, *curve, bases, parameters, notes);
    return false;
  }
  if (!in.has(kTransmissionError)) in.required(kTransmissionError);
  const std::vector<double> amplitudes = in.numbers(kTransmissionError);
  const std::vector<double> phases = in.numbers(kErrorPhase);
  for (const auto& [key, list] :
       {std::pair(&kTransmissionError, &amplitudes), std::pair(&kErrorPhase, &phases)}) {
    const std::size_t most = key == &kErrorPhase ? amplitudes.size() : kMostHarmonics;
    const bool may_be_missing = key == &kErrorPhase;
    if (list->size() > most || (list->empty() && !may_be_missing)) {
      fail_at(in.node(*key),
              fmt::format("{} has {} numbers; {} is possible", key->name, list->size(),
                          key == &kErrorPhase ? "at most one for each harmonic of the error"
                                              : fmt::format("1 to {}", kMostHarmonics)));
    }
  }
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const double error = amplitudes[i] * 1e-6;
    parameters->add(name_in_list("e0", i), error / bases.b_n, kTransmissionError,
                    fmt::format("e/b_n = {:.6g} m / {:.6g} m", error, bases.b_n));
  }
  for (std::size_t i = 0; i < phases.size(); ++i) {
    parameters->add(name_in_list("e0_phase", i), phases[i] * std::numbers::pi / 180.0, kErrorPhase,
                    fmt::format("{:.6g} degrees", phases[i]));
  }
  return amplitudes.size() == 1;
}

// A spline through the errors of the teeth, where each enters, and its second derivative.
void add_pitch_errors(const std::string& gear, const std::vector<double>& errors,
                      const Bases& bases, Curves* curves) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<TablePoint> points;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    points.push_back({kTurn * static_cast<double>(i) / static_cast<double>(errors.size()),
                      errors[i] * 1e-6 / bases.b_n});
  }
  const auto table =
      std::make_shared<const PeriodicTable>("pitch errors", points, Interpolation::cubic);
  (*curves)["pitch_" + gear] = {
      [table](double phase, double toward) { return table->at(kTurn * phase, kTurn * toward); },
      {}};
  (*curves)["pitch_bend_" + gear] = {[table](double phase, double toward) {
                                       return -table->bend_at(kTurn * phase, kTurn * toward);
                                     },
                                     {}};
}

// What comes back once per turn of a gear. Returns whether there is any runout or pitch error.
bool add_faults(GearReader& in, const Geometry& geometry, const Bases& bases,
                Parameters* parameters, Curves* curves) {
  const std::vector<double> runout = in.pair_or_zero(kRunout);
  const std::vector<double> phase = in.pair_or_zero(kRunoutPhase);
  const std::vector<double> damage = in.pair_or_zero(kDamage);
  const std::array<double, 2> teeth = {geometry.pinion_teeth, geometry.gear_teeth};
  std::size_t cycle = 1;
  bool is_faulty = false, has_pitch = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string gear = i == 0 ? "p" : "g";
    if (in.has(kRunout)) {
      parameters->add("runout_" + gear, runout[i] * 1e-6 / bases.b_n, kRunout,
                      fmt::format("{:.6g} m / {:.6g} m", runout[i] * 1e-6, bases.b_n));
    }
    if (in.has(kRunoutPhase)) {
      parameters->add("runout_phase_" + gear, phase[i] * std::numbers::pi / 180.0, kRunoutPhase,
                      fmt::format("{:.6g} degrees", phase[i]));
    }
    if (in.has(kDamage)) parameters->add("damage_" + gear, damage[i], kDamage, "as given");
    // An axis may begin with 0.
    const auto pitch = errors_of_teeth(in, i == 0 ? kPinionPitch : kGearPitch, teeth[i]);
    if (pitch) add_pitch_errors(gear, *pitch, bases, curves);
    has_pitch = has_pitch || pitch;
    const bool turns =
        in.is_swept(kRunout) || in.is_swept(kDamage) || runout[i] > 0.0 || damage[i] > 0.0 || pitch;
    if (turns) cycle = std::lcm(cycle, static_cast<std::size_t>(teeth[i]));
    is_faulty = is_faulty || turns;
  }
  if (is_faulty) {
    parameters->add(
        "cycle", static_cast<double>(cycle), kTeeth,
        fmt::format("mesh periods until all faults come back: {:.6g} turns of the "
                    "pinion, {:.6g} of the gear",
                    static_cast<double>(cycle) / teeth[0], static_cast<double>(cycle) / teeth[1]));
  }
  return has_pitch || in.is_swept(kRunout) || runout[0] > 0.0 || runout[1] > 0.0;
}

// The curve divided by `unit`; phases in turns.
Curve curve_of(const MeasuredCurve& measured, double unit) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Curve curve;
  curve.at = [table = measured.table, unit](double phase, double toward) {
    return table->at(kTurn * phase, kTurn * toward) / unit;
  };
  for (const double jump : measured.table->jumps()) {
    curve.jumps.push_back(jump / kTurn - std::floor(jump / kTurn));
  }
  return curve;
}

void add_stiffness(GearReader& in, const std::optional<MeasuredCurve>& stiffness,
                   Interpolation interpolation, const Bases& bases, GearConversion* out) {
  const auto share = measured_curve(in, kLoadShareFile, interpolation);
  if (!stiffness) {
    if (share) fail_at(in.node(kLoadShareFile), "load_share_file goes with stiffness_file");
    return;
  }
  const bool keeps = in.choice(kStiffnessMean) == "keep";
  out->curves["stiffness"] = curve_of(*stiffness, keeps ? bases.k0 : stiffness->mean);
  if (share) out->curves["load_share"] = curve_of(*share, 1.0);
  out->options.push_back({"stiffness", "table"});
  out->notes.push_back(fmt::format(
      "mesh stiffness from '{}': mean {:.6g} N/m, which is {:.6g} k0{}", stiffness->table->name(),
      stiffness->mean, stiffness->mean / bases.k0, keeps ? "" : ", scaled to k0"));
}

}  // namespace

const Model& gear_table_model() {
  static const Model& model = *find_model("gear5");
  return model;
}

GearConversion convert_gear(const toml::table& gear, const GearValues& values) {
  GearReader in(gear, values);
  Parameters parameters(in);
  GearConversion out;
  const Geometry geometry = read_geometry(in);
  add_geometry(in, geometry, &parameters, &out.notes);
  const Path path = read_path(in, geometry, &parameters, &out.notes);
  const Interpolation interpolation =
      in.choice(kInterpolation) == "cubic" ? Interpolation::cubic : Interpolation::linear;
  const auto stiffness = measured_curve(in, kStiffnessFile, interpolation);
  if (stiffness && !(stiffness->mean > 0.0)) {
    fail_at(in.node(kStiffnessFile), "the mean of the stiffness must be greater than 0");
  }
  const Bases bases =
      read_bases(in, geometry, path.contact_ratio(), stiffness ? stiffness->mean : 0.0, &out.notes);
  add_masses(in, bases, &parameters);
  add_springs_and_dampers(in, bases, &parameters);
  add_lengths_and_loads(in, geometry, bases, &parameters);
  const bool is_sine = add_transmission_error(in, bases, &parameters, &out.notes);
  const bool has_runout = add_faults(in, geometry, bases, &parameters, &out.curves);
  add_stiffness(in, stiffness, interpolation, bases, &out);
  if (!is_sine || has_runout) out.options.push_back({"error", "series"});

  const double turns_per_omega = bases.varpi / (2.0 * std::numbers::pi * geometry.pinion_teeth);
  out.scales = {bases.varpi, bases.b_n, bases.k0, 60.0 * turns_per_omega};
  out.notes.push_back(fmt::format("pinion speed at omega = 1: {:.6g} rpm (60 varpi/(2 pi zp))",
                                  out.scales.rpm_per_omega));
  if (const std::optional<double> speed = in.optional(kSpeed)) {
    parameters.add("omega", *speed / out.scales.rpm_per_omega, kSpeed,
                   fmt::format("zp 2 pi n/60 / varpi = {:.6g} rpm / {:.6g} rpm", *speed,
                               out.scales.rpm_per_omega));
  }
  out.parameters = parameters.take();
  return out;
}

}  // namespace gearsweep
