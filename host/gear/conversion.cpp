#include "gear/conversion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "gear/detail/bases.hpp"
#include "gear/detail/bodies.hpp"
#include "gear/detail/contact_path.hpp"
#include "gear/detail/doubts.hpp"
#include "gear/detail/dynamic_factor_input.hpp"
#include "gear/detail/engagement.hpp"
#include "gear/detail/faults.hpp"
#include "gear/detail/mesh_stiffness.hpp"
#include "gear/detail/missing_keys.hpp"
#include "gear/detail/torque.hpp"
#include "gear/detail/transmission_error.hpp"

namespace gearsweep {
namespace {

void add_geometry(const GearDrawing& drawing, const GearGeometry& geometry, GearTarget* target) {
  const double degrees = geometry.alpha * 180.0 / std::numbers::pi;
  target->note(
      "base radii Rp = {:.7g} mm, Rg = {:.7g} mm (module z/2 cos(alpha)); "
      "base pitch {:.7g} mm",
      geometry.pinion_base, geometry.gear_base, geometry.base_pitch);
  target->note("working pressure angle {:.6g} degrees at centre distance {:.6g} mm", degrees,
               geometry.centre);
  target->add("zp", geometry.pinion_teeth, kTeeth, "teeth of the pinion as given");
  target->add("teeth_ratio", geometry.gear_teeth / geometry.pinion_teeth, kTeeth, "zg/zp = {} / {}",
              geometry.gear_teeth, geometry.pinion_teeth);
  if (geometry.helix > 0.0) {
    if (!drawing.has(kFaceWidth)) {
      throw DrawingError(
          kFaceWidth, fmt::format("{} needs 'face_width_mm': helical teeth (helix_angle_deg) come "
                                  "into contact along it, which is the overlap ratio",
                                  drawing.name()));
    }
    const double width = drawing.required(kFaceWidth);
    target->add("overlap", geometry.overlap(width), kHelix,
                "b sin(beta)/(pi m) = {:.6g} mm / {:.6g} mm", width * std::sin(geometry.helix),
                std::numbers::pi * geometry.module);
    target->note(
        "helical teeth: radii, pressure angle, torque's force and backlash are those "
        "of the transverse section; axial forces are left out");
  }
  const GearKey& origin = drawing.has(kCentreDistance) ? kCentreDistance : kPressureAngle;
  target->add("alpha", degrees, origin, "working pressure angle at a = {:.6g} mm", geometry.centre);
}

void add_masses(const GearBodies& bodies, const GearBases& bases, GearTarget* target) {
  const double sum = bases.pinion_mesh_mass + bases.gear_mesh_mass;
  target->add("rho_p", bases.gear_mesh_mass / sum, kInertia, "me/(Ip/Rp^2) = {:.6g} kg / {:.6g} kg",
              bases.me, bases.pinion_mesh_mass);
  target->add("rho_g", bases.pinion_mesh_mass / sum, kInertia,
              "me/(Ig/Rg^2) = {:.6g} kg / {:.6g} kg", bases.me, bases.gear_mesh_mass);
  if (!target->takes(kMass)) return;
  const std::vector<double>& mass = bodies.mass;
  target->add("m1", bases.me / mass[0], kMass, "me/mp = {:.6g} kg / {:.6g} kg", bases.me, mass[0]);
  target->add("m2", bases.me / mass[1], kMass, "me/mg = {:.6g} kg / {:.6g} kg", bases.me, mass[1]);
}

// Returns cm in N s/m.
double add_mesh_damping(const GearDrawing& drawing, const GearBases& bases, GearTarget* target) {
  const double critical = 2.0 * bases.varpi * bases.me;
  const int dampers = target->mesh_dampers();
  if (const std::optional<double> ratio = drawing.number(kDampingRatio)) {
    if (drawing.has(kMeshDamping)) {
      throw DrawingError(kDampingRatio,
                         "mesh_damping_ratio and mesh_damping_N_s_per_mm are two numbers for one "
                         "thing; give one of them");
    }
    // The critical value is that of the mesh as it is; zeta counts in that of k0.
    const double stiffer = std::sqrt(bases.stiffness_factor);
    const double zeta = stiffer * *ratio / dampers;
    target->add("zeta", zeta, kDampingRatio, "ratio/{} = {:.6g}/{}{}: cm = {:.6g} N s/m{}", dampers,
                *ratio, dampers,
                stiffer == 1.0 ? "" : fmt::format(" {:.6g}, for stiffness_factor", stiffer),
                zeta * critical, dampers == 1 ? "" : " in each pair of teeth");
    return zeta * critical;
  }
  const double cm = drawing.required(kMeshDamping) * 1e3;
  target->add("zeta", cm / critical, kMeshDamping,
              "cm/(2 varpi me) = {:.6g} N s/m / (2 {:.6g} rad/s {:.6g} kg)", cm, bases.varpi,
              bases.me);
  return cm;
}

void add_springs_and_dampers(const GearDrawing& drawing, const GearBases& bases,
                             GearTarget* target) {
  const double cm = target->takes(kMeshDamping) ? add_mesh_damping(drawing, bases, target) : 0.0;
  for (std::size_t i = 0; target->takes(kBearingStiffness) && i < kBearingStiffness.count(); ++i) {
    const double spring = drawing.list(kBearingStiffness)[i] * 1e3;
    target->add(fmt::format("k{}", i + 1), spring / bases.k0, kBearingStiffness,
                "K{}/k0 = {:.6g} N/m / {:.6g} N/m", i + 1, spring, bases.k0);
  }
  for (std::size_t i = 0; target->takes(kBearingDamping) && i < kBearingDamping.count(); ++i) {
    const double damper = drawing.list(kBearingDamping)[i] * 1e3;
    if (cm == 0.0 && damper > 0.0) {
      throw DrawingError(
          kMeshDamping,
          "mesh_damping_N_s_per_mm = 0 with bearing damping: the model counts bearing damping in "
          "mesh damping (c = C/cm); give a positive number, or no damping at all");
    }
    target->add(fmt::format("c{}", i + 1), cm == 0.0 ? 0.0 : damper / cm, kBearingDamping,
                "C{}/cm = {:.6g} N s/m / {:.6g} N s/m", i + 1, damper, cm);
  }
}

void add_bases(const GearBases& bases, GearTarget* target) {
  target->add("k0", bases.k0, kMeshStiffness, "mean mesh stiffness");
  target->add("b_n", bases.b_n, kHalfBacklash, "half backlash");
  target->add("varpi", bases.varpi, kInertia, "sqrt(k0/me)");
}

void add_stiffness_factor(const GearDrawing& drawing, const GearBases& bases, GearTarget* target) {
  if (!drawing.has(kStiffnessFactor)) return;
  target->add("stiffness_factor", bases.stiffness_factor, kStiffnessFactor,
              "mean mesh stiffness {:.6g} N/m", bases.stiffness_factor * bases.k0);
}

void add_lengths(const GearGeometry& geometry, const GearBases& bases, GearTarget* target) {
  const double centre = geometry.centre * 1e-3;
  target->add("b", bases.half_backlash / bases.b_n, kHalfBacklash,
              "{:.6g} m / {:.6g} m: the half backlash of the drawing is the unit of "
              "length",
              bases.half_backlash, bases.b_n);
  target->add("A", centre / bases.b_n, kHalfBacklash, "a/b_n = {:.6g} m / {:.6g} m", centre,
              bases.b_n);
}

void add_speed(const GearDrawing& drawing, double rpm_per_omega, GearTarget* target) {
  target->note("pinion speed at omega = 1: {:.6g} rpm (60 varpi/(2 pi zp))", rpm_per_omega);
  const std::optional<double> speed = drawing.number(kSpeed);
  if (!speed) return;
  target->add("omega", *speed / rpm_per_omega, kSpeed,
              "zp 2 pi n/60 / varpi = {:.6g} rpm / {:.6g} rpm", *speed, rpm_per_omega);
}

}  // namespace

GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const std::string& suffix, GearTexts texts) {
  GearTarget target(drawing, model, suffix, texts);
  require_keys(drawing, target);
  const GearGeometry geometry = geometry_of(drawing);
  add_geometry(drawing, geometry, &target);
  const ContactPath path = add_contact_path(drawing, geometry, &target);
  const std::optional<MeasuredCurve> stiffness = measured_stiffness(drawing);
  const GearBodies bodies = bodies_of(drawing, geometry, &target);
  const GearBases bases = bases_of(drawing, geometry, bodies, path.contact_ratio(),
                                   stiffness ? stiffness->mean : 0.0, &target);
  add_bases(bases, &target);
  add_stiffness_factor(drawing, bases, &target);
  add_masses(bodies, bases, &target);
  add_springs_and_dampers(drawing, bases, &target);
  add_lengths(geometry, bases, &target);
  add_torque(drawing, bases, &target);
  add_engagement(drawing, geometry, path, bases, &target);
  const bool is_sine = add_transmission_error(drawing, geometry, path, bases.b_n, &target);
  const bool has_runout = add_faults(drawing, geometry, bases.b_n, &target);
  add_stiffness(drawing, stiffness, bases.k0, &target);
  const auto factor = dynamic_factor_input(drawing, geometry, path, bases, &target);
  if (!is_sine || has_runout) target.choose("error", "series");
  const double rpm_per_omega =
      60.0 * (bases.varpi / (2.0 * std::numbers::pi * geometry.pinion_teeth));
  add_speed(drawing, rpm_per_omega, &target);

  GearConversion out = target.take();
  out.scales = {bases.varpi, bases.b_n, bases.k0, rpm_per_omega};
  out.dynamic_factor = factor;
  if (texts == GearTexts::none) return out;
  const WorkedOut worked_out = {
      bodies.mass,     bodies.inertia,       bases.k0,
      geometry.centre, path.contact_ratio(), target.takes(kTorque) ? mean_torque(drawing) : 0.0};
  out.data = data_of(drawing, worked_out, [&](const GearKey& key) { return target.takes(key); });
  out.doubts = doubts_about(drawing, geometry);
  return out;
}

}  // namespace gearsweep
