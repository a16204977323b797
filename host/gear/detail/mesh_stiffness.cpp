#include "gear/detail/mesh_stiffness.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gearsweep {
namespace {

// C_B of ISO 6336-1: one factor of the dedendum, one of the normal pressure angle.
double rack_factor(const GearDrawing& drawing, const GearGeometry& geometry) {
  const double of_angle = 1.0 - 0.02 * (20.0 - drawing.number(kPressureAngle).value_or(20.0));
  const std::optional<double> dedendum = drawing.number(kDedendum);
  if (!dedendum) return 0.975 * of_angle;
  const double in_modules = *dedendum / geometry.module;
  if (!(in_modules >= 1.0 && in_modules <= 2.0)) {
    throw DrawingError(kDedendum,
                       fmt::format("dedendum_mm = {:.6g} is {:.4g} modules; 1 to 2 modules "
                                   "are possible",
                                   *dedendum, in_modules));
  }
  return (1.0 + 0.5 * (1.2 - in_modules)) * of_angle;
}

}  // namespace

std::optional<MeasuredCurve> measured_stiffness(const GearDrawing& drawing) {
  auto curve = measured_curve(drawing, kStiffnessFile, stiffness_interpolation(drawing));
  if (curve && !(curve->mean > 0.0)) {
    throw DrawingError(kStiffnessFile, "the mean of the stiffness must be greater than 0");
  }
  return curve;
}

double mean_mesh_stiffness(const GearDrawing& drawing, const GearGeometry& geometry,
                           double contact_ratio, double measured, GearTarget* target) {
  const bool needs_width =
      geometry.helix > 0.0 || drawing.has(kPitchDeviation) || drawing.choice(kBody) == "solid";
  if (drawing.has(kMeshStiffness) && drawing.has(kFaceWidth) && !needs_width) {
    throw DrawingError(
        kFaceWidth,
        "mesh_stiffness_N_per_m and face_width_mm both give the mesh stiffness; keep one");
  }
  if (drawing.has(kDedendum) && (drawing.has(kMeshStiffness) || measured > 0.0)) {
    throw DrawingError(
        kDedendum,
        "dedendum_mm goes into the stiffness by face_width_mm, and another stiffness is given");
  }
  if (drawing.has(kMeshStiffness)) {
    const double k0 = drawing.required(kMeshStiffness);
    target->note("mean mesh stiffness k0 = {:.6g} N/m as given", k0);
    return k0;
  }
  if (measured > 0.0) {
    target->note("mean mesh stiffness k0 = {:.6g} N/m as measured", measured);
    return measured;
  }
  if (!drawing.has(kFaceWidth)) {
    throw DrawingError(
        kFaceWidth, drawing.name() +
                        " needs 'mesh_stiffness_N_per_m' (mean mesh stiffness) or 'face_width_mm'");
  }
  const double width = drawing.required(kFaceWidth);
  const double slant = std::cos(geometry.helix);
  const double z1 = geometry.pinion_teeth / (slant * slant * slant);
  const double z2 = geometry.gear_teeth / (slant * slant * slant);
  const double x1 = geometry.shift[0], x2 = geometry.shift[1];
  const double q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1 -
                   0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1 * x1 + 0.00182 * x2 * x2;
  const double rack = rack_factor(drawing, geometry);
  const double single = 0.8 * rack / q * slant;
  const double mesh = single * pairs_in_mean(contact_ratio);
  const double k0 = mesh * width * 1e6;
  target->note(
      "mean mesh stiffness k0 = {:.6g} N/m from ISO 6336-1 method B (steel): "
      "q' = {:.6g} um mm/N, C_B = {:.6g}, c' = {:.6g}, c_gamma = {:.6g} N/(um mm), "
      "face width {:.6g} "
      "mm",
      k0, q, rack, single, mesh, width);
  return k0;
}

void add_stiffness(const GearDrawing& drawing, const std::optional<MeasuredCurve>& stiffness,
                   double k0, GearTarget* target) {
  const auto share = measured_curve(drawing, kLoadShareFile, stiffness_interpolation(drawing));
  const bool keeps = drawing.choice(kStiffnessMean) == "keep";
  if (!stiffness) {
    if (share) throw DrawingError(kLoadShareFile, "load_share_file goes with stiffness_file");
    return;
  }
  target->add_curve("measured_stiffness", stiffness->in(keeps ? k0 : stiffness->mean));
  if (share) target->add_curve("load_share", share->in(1.0));
  target->choose("stiffness", "table");
  target->note("mesh stiffness from '{}': mean {:.6g} N/m, which is {:.6g} k0{}",
               stiffness->table->name(), stiffness->mean, stiffness->mean / k0,
               keeps ? "" : ", scaled to k0");
}

}  // namespace gearsweep
