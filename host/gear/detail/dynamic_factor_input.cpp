#include "gear/detail/dynamic_factor_input.hpp"

#include <fmt/format.h>

#include <cmath>

#include "gear/detail/mesh_stiffness.hpp"

namespace gearsweep {

std::optional<DynamicFactorInput> dynamic_factor_input(const GearDrawing& drawing,
                                                       const GearGeometry& geometry,
                                                       const ContactPath& path,
                                                       const GearBases& bases, GearTarget* target) {
  const std::optional<double> pitch = drawing.number(kPitchDeviation);
  const std::optional<double> profile = drawing.number(kProfileDeviation);
  const std::optional<double> relief = drawing.number(kTipRelief);
  for (const GearKey& key : {kPitchDeviation, kProfileDeviation, kTipRelief}) {
    if (!drawing.has(key)) continue;
    for (const GearKey& needed : {kPitchDeviation, kProfileDeviation, kFaceWidth}) {
      if (drawing.has(needed)) continue;
      throw DrawingError(key, fmt::format("{} is for K_v, which needs '{}', too ({})", key.name,
                                          needed.name, needed.meaning));
    }
  }
  if (!pitch) return std::nullopt;
  const double width = drawing.required(kFaceWidth);
  const double mesh = bases.stiffness_factor * bases.k0 * 1e-6 / width;
  DynamicFactorInput out;
  out.single_stiffness = mesh / pairs_in_mean(path.contact_ratio());
  out.contact_ratio = path.contact_ratio() + geometry.overlap(width);
  out.pitch_deviation = *pitch;
  out.profile_deviation = *profile;
  out.tip_relief = relief;
  out.resonance = std::sqrt(bases.stiffness_factor);
  // The torque's force at the reference circle is smaller than that along the line of action.
  const double to_reference = geometry.pinion_base / geometry.reference(geometry.pinion_teeth);
  out.line_load_per_load = bases.k0 * bases.b_n * to_reference / width;
  target->note(
      "K_v by ISO 6336-1 method B: c' = {:.6g}, c_gamma = {:.6g} N/(um mm), "
      "eps_gamma = {:.6g}, a line load of {:.4g} N/mm for each N m; after running-in "
      "f_pb = {:.4g} um, f_falpha = {:.4g} um",
      out.single_stiffness, mesh, out.contact_ratio,
      1e3 / geometry.reference(geometry.pinion_teeth) / width,
      run_in_deviation(out.pitch_deviation), run_in_deviation(out.profile_deviation));
  return out;
}

}  // namespace gearsweep
