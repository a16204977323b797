#include "study/detail/gear_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "study/builtin_models.hpp"
#include "study/detail/gear_parts.hpp"

namespace gearsweep {
namespace {

constexpr const char* kGearModel = "gear5";

// C_B of ISO 6336-1: one factor of the dedendum, one of the normal pressure angle.
double read_rack_factor(GearReader& in, const GearGeometry& geometry) {
  const double of_angle = 1.0 - 0.02 * (20.0 - in.optional(kPressureAngle).value_or(20.0));
  const std::optional<double> dedendum = in.optional(kDedendum);
  if (!dedendum) return 0.975 * of_angle;
  const double in_modules = *dedendum / geometry.module;
  if (!(in_modules >= 1.0 && in_modules <= 2.0)) {
    fail_at(in.node(kDedendum),
            fmt::format("dedendum_mm = {:.6g} is {:.4g} modules; 1 to 2 modules "
                        "are possible",
                        *dedendum, in_modules));
  }
  return (1.0 + 0.5 * (1.2 - in_modules)) * of_angle;
}

// Mean mesh stiffness k0 in N/m, as given or from the face width: ISO 6336-1, method B, for steel
// (theoretical single stiffness 1/q', model factor 0.8, basic rack factor C_B, helix factor
// cos(beta)). Without either, the mean of what was measured, if that is above 0.
double read_mesh_stiffness(GearReader& in, const GearGeometry& geometry, double contact_ratio,
                           double measured, std::vector<std::string>* notes) {
  const bool needs_width = geometry.helix > 0.0 || in.has(kPitchDeviation);
  if (in.has(kMeshStiffness) && in.has(kFaceWidth) && !needs_width) {
    fail_at(in.node(kFaceWidth),
            "mesh_stiffness_N_per_m and face_width_mm both give the mesh stiffness; keep one");
  }
  if (in.has(kDedendum) && (in.has(kMeshStiffness) || measured > 0.0)) {
    fail_at(in.node(kDedendum),
            "dedendum_mm goes into the stiffness by face_width_mm, and another stiffness is given");
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
  const double rack = read_rack_factor(in, geometry);
  const double single = 0.8 * rack / q * slant;
  const double mesh = single * pairs_in_mean(contact_ratio);
  const double k0 = mesh * width * 1e6;
  notes->push_back(
      fmt::format("mean mesh stiffness k0 = {:.6g} N/m from ISO 6336-1 method B (steel): "
                  "q' = {:.6g} um mm/N, C_B = {:.6g}, c' = {:.6g}, c_gamma = {:.6g} N/(um mm), "
                  "face width {:.6g} "
                  "mm",
                  k0, q, rack, single, mesh, width));
  return k0;
}

GearBases read_bases(GearReader& in, const GearGeometry& geometry, double contact_ratio,
                     double measured_stiffness, std::vector<std::string>* notes) {
  const std::vector<double> inertia = in.list(kInertia, 2);
  GearBases out{};
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

void add_geometry(GearReader& in, const GearGeometry& geometry, GearParameters* parameters,
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
    parameters->add(
        "overlap", geometry.overlap(width), kHelix,
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

void add_masses(GearReader& in, const GearBases& bases, GearParameters* parameters) {
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

void add_springs_and_dampers(GearReader& in, const GearBases& bases, GearParameters* parameters) {
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

void add_lengths_and_loads(GearReader& in, const GearGeometry& geometry, const GearBases& bases,
                           GearParameters* parameters) {
  const double centre = geometry.centre * 1e-3;
  parameters->add("b", 1.0, kHalfBacklash, "the half backlash b_n is the unit of length");
  parameters->add("A", centre / bases.b_n, kHalfBacklash,
                  fmt::format("a/b_n = {:.6g} m / {:.6g} m", centre, bases.b_n));
  const double torque = in.required(kTorque);
  parameters->add("F1", torque / (bases.pinion_base * bases.k0 * bases.b_n), kTorque,
                  fmt::format("T/(Rp k0 b_n) = {:.6g} N m / ({:.6g} m {:.6g} N/m {:.6g} m)", torque,
                              bases.pinion_base, bases.k0, bases.b_n));
}

}  // namespace

const Model& gear_table_model() {
  static const Model& model = *find_model(kGearModel);
  return model;
}

bool is_gear_table_model(const Model& model) {
  return model.name == kGearModel && model.text == *model_text(kGearModel);
}

GearConversion convert_gear(const toml::table& gear, const GearValues& values) {
  GearReader in(gear, values);
  GearParameters parameters(in);
  GearConversion out;
  const GearGeometry geometry = read_geometry(in);
  add_geometry(in, geometry, &parameters, &out.notes);
  const ContactPath path = read_path(in, geometry, &parameters, &out.notes);
  const Interpolation interpolation =
      in.choice(kInterpolation) == "cubic" ? Interpolation::cubic : Interpolation::linear;
  const auto stiffness = measured_curve(in, kStiffnessFile, interpolation);
  if (stiffness && !(stiffness->mean > 0.0)) {
    fail_at(in.node(kStiffnessFile), "the mean of the stiffness must be greater than 0");
  }
  const GearBases bases =
      read_bases(in, geometry, path.contact_ratio(), stiffness ? stiffness->mean : 0.0, &out.notes);
  add_masses(in, bases, &parameters);
  add_springs_and_dampers(in, bases, &parameters);
  add_lengths_and_loads(in, geometry, bases, &parameters);
  const bool is_sine = add_transmission_error(in, geometry, path, bases, &parameters, &out.notes);
  const bool has_runout = add_faults(in, geometry, bases, &parameters, &out.curves);
  add_stiffness(in, stiffness, interpolation, bases, &out);
  out.dynamic_factor = read_dynamic_factor(in, geometry, path, bases, &out.notes);
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
  out.doubts = doubts_about(in, geometry);
  out.parameters = parameters.take();
  return out;
}

}  // namespace gearsweep
