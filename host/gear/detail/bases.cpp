#include "gear/detail/bases.hpp"

#include <fmt/format.h>

#include <cmath>

#include "gear/detail/mesh_stiffness.hpp"

namespace gearsweep {

GearBases bases_of(const GearDrawing& drawing, const GearGeometry& geometry,
                   const GearBodies& bodies, double contact_ratio, double measured_stiffness,
                   GearTarget* target) {
  const std::vector<double>& inertia = bodies.inertia;
  GearBases out{};
  out.pinion_mesh_mass = inertia[0] / (geometry.pinion_base * geometry.pinion_base);
  out.gear_mesh_mass = inertia[1] / (geometry.gear_base * geometry.gear_base);
  out.me = out.pinion_mesh_mass * out.gear_mesh_mass / (out.pinion_mesh_mass + out.gear_mesh_mass);
  target->note(
      "me = {:.6g} kg from 1/me = Rp^2/Ip + Rg^2/Ig, Ip/Rp^2 = {:.6g} kg, "
      "Ig/Rg^2 = {:.6g} kg",
      out.me, out.pinion_mesh_mass, out.gear_mesh_mass);
  out.k0 = mean_mesh_stiffness(drawing, geometry, contact_ratio, measured_stiffness, target);
  out.stiffness_factor = drawing.number(kStiffnessFactor).value_or(1.0);
  // Where the model counts the backlash in b_n, another backlash needs no other unit.
  out.half_backlash = drawing.required(kHalfBacklash) * 1e-3;
  out.b_n = target->has_parameter("b") ? drawing.unvaried(kHalfBacklash) * 1e-3 : out.half_backlash;
  out.varpi = std::sqrt(out.k0 / out.me);
  out.pinion_base = geometry.pinion_base * 1e-3;
  target->note("varpi = sqrt(k0/me) = {:.6g} rad/s", out.varpi);
  return out;
}

}  // namespace gearsweep
