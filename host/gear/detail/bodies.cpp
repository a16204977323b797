#include "gear/detail/bodies.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "gear/steel.hpp"

namespace gearsweep {
namespace {

struct Disc {
  double mass, inertia;
};

Disc disc_of(const GearDrawing& drawing, const GearGeometry& geometry, std::size_t gear) {
  const double outer = geometry.reference(gear == 0 ? geometry.pinion_teeth : geometry.gear_teeth);
  const double inner = 0.5 * drawing.pair_or_zero(kBore)[gear];
  if (inner >= outer) {
    throw DrawingError(kBore,
                       fmt::format("bore_mm = {:g} of the {} leaves nothing of its reference "
                                   "diameter, {:.6g} mm",
                                   2.0 * inner, kWhose[gear], 2.0 * outer));
  }
  const double mass =
      kSteel * std::numbers::pi * (outer * outer - inner * inner) * drawing.required(kFaceWidth);
  return {mass, 0.5 * mass * (outer * outer + inner * inner)};
}

}  // namespace

GearBodies bodies_of(const GearDrawing& drawing, const GearGeometry& geometry, GearTarget* target) {
  const bool is_solid = drawing.choice(kBody) == "solid";
  const std::vector<double> bore = drawing.pair_or_zero(kBore);
  if (!is_solid && (bore[0] > 0.0 || bore[1] > 0.0)) {
    throw DrawingError(kBore,
                       "bore_mm is that of body = \"solid\"; here mass and inertia are given");
  }
  if (!is_solid) return {drawing.numbers(kMass), drawing.list(kInertia)};
  if (!drawing.has(kFaceWidth)) {
    throw DrawingError(kFaceWidth, drawing.name() +
                                       " needs 'face_width_mm': the discs of body = "
                                       "\"solid\" are as wide");
  }
  if (drawing.has(kMass) && drawing.has(kInertia)) {
    throw DrawingError(kBody,
                       "body = \"solid\" with mass_kg and inertia_kg_mm2: there is nothing "
                       "left to estimate; give some of them alone");
  }
  GearBodies bodies = {drawing.numbers(kMass), drawing.numbers(kInertia)};
  const std::array<Disc, 2> discs = {disc_of(drawing, geometry, 0), disc_of(drawing, geometry, 1)};
  const auto estimate = [&](const GearKey& key, double Disc::*what, const char* unit,
                            std::vector<double>* numbers) {
    if (!numbers->empty()) return;
    *numbers = {discs[0].*what, discs[1].*what};
    target->note(
        "{}: {:.6g} and {:.6g} {}, an estimate: steel discs of the reference "
        "diameters",
        key.meaning, discs[0].*what, discs[1].*what, unit);
  };
  estimate(kMass, &Disc::mass, "kg", &bodies.mass);
  estimate(kInertia, &Disc::inertia, "kg mm^2", &bodies.inertia);
  return bodies;
}

}  // namespace gearsweep
