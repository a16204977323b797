#include "rexs/detail/shaft_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rexs/detail/materials.hpp"

namespace gearsweep {
namespace {

constexpr double kSteelDensity = 7.85;  // kg/dm^3

std::vector<ShaftSection> sections_of(const RexsComponent& shaft, RexsLookup* lookup) {
  std::vector<ShaftSection> sections;
  double end = 0.0;
  for (const RexsComponent* one : lookup->related(shaft, "assembly", "assembly", "part")) {
    if (one->type != "shaft_section") continue;
    const auto length = [&](const char* name) {
      return lookup->number(*one, name, RexsQuantity::length);
    };
    ShaftSection section;
    section.begin = length("u_coordinate_on_shaft").value_or(end);
    section.length = length("length").value_or(0.0);
    section.outer[0] = length("outer_diameter_begin").value_or(0.0);
    section.outer[1] = length("outer_diameter_end").value_or(section.outer[0]);
    section.inner[0] = length("inner_diameter_begin").value_or(0.0);
    section.inner[1] = length("inner_diameter_end").value_or(section.inner[0]);
    end = section.begin + section.length;
    if (section.length <= 0.0 || section.inner[0] < 0.0 || section.inner[1] < 0.0 ||
        section.outer[0] < section.inner[0] || section.outer[1] < section.inner[1]) {
      lookup->note(fmt::format("{}: no body: length and diameters do not fit; left out of the mass",
                               lookup->place(*one)));
      continue;
    }
    sections.push_back(section);
  }
  return sections;
}

BodyMass minus(const BodyMass& a, const BodyMass& b) {
  return {a.mass - b.mass, a.inertia - b.inertia};
}

// The outside of the shaft between two places along it, filled.
BodyMass filled(const std::vector<ShaftSection>& sections, double from, double to, double density) {
  BodyMass sum;
  for (const ShaftSection& one : sections) {
    const double a = std::max(from, one.begin), b = std::min(to, one.begin + one.length);
    if (a >= b) continue;
    const auto at = [&](double u) {
      return std::lerp(one.outer[0], one.outer[1], (u - one.begin) / one.length);
    };
    const BodyMass piece = frustum(b - a, at(a), at(b), density);
    sum = {sum.mass + piece.mass, sum.inertia + piece.inertia};
  }
  return sum;
}

// The integral of 32/(pi (D^4 - d^4)) between two places of a section, in 1/mm^3, by Simpson's
// rule; a cylinder's is exact.
double twist_of(const ShaftSection& section, double from, double to) {
  constexpr int kPieces = 64;
  const auto at = [&](int i) {
    const double u = std::lerp(from, to, static_cast<double>(i) / kPieces);
    const double share = (u - section.begin) / section.length;
    const double outer = std::lerp(section.outer[0], section.outer[1], share);
    const double inner = std::lerp(section.inner[0], section.inner[1], share);
    return 32.0 / (std::numbers::pi * (std::pow(outer, 4) - std::pow(inner, 4)));
  };
  double sum = 0.0;
  for (int i = 0; i < kPieces; i += 2) sum += at(i) + 4.0 * at(i + 1) + at(i + 2);
  return sum / 3.0 * (to - from) / kPieces;
}

class ShaftScale {
 public:
  ShaftScale(const RexsComponent& component, RexsLookup* lookup, UnitShaft* shaft)
      : component_(component), lookup_(lookup), shaft_(shaft) {
    shaft->sections = sections_of(component, lookup);
    const RexsMaterial material = material_of(component, lookup);
    shaft->shear_modulus = material.shear;
    density_ = material.density.value_or(kSteelDensity);
  }

  void add_sections() {
    BodyMass sum;
    for (const ShaftSection& one : shaft_->sections) {
      const BodyMass body = minus(frustum(one.length, one.outer[0], one.outer[1], density_),
                                  frustum(one.length, one.inner[0], one.inner[1], density_));
      sum = {sum.mass + body.mass, sum.inertia + body.inertia};
    }
    const auto given = lookup_->number(component_, "mass_of_component", RexsQuantity::mass);
    if (given && *given > 0.0 && sum.mass > 0.0) {
      sum = {*given, sum.inertia * *given / sum.mass};
    }
    if (!shaft_->sections.empty()) add(fmt::format("{} sections", shaft_->sections.size()), sum);
  }

  void add_gear(UnitGear* own, const RexsComponent& component) {
    const UnitGear& gear = *own;
    if (gear.is_ring || !gear.teeth || !gear.module || !gear.face_width) {
      lookup_->note(fmt::format("{}: its body is left out of the mass of its shaft, {}",
                                lookup_->place(component), shaft_->name));
      return;
    }
    const double helix = gear.helix.value_or(0.0) * std::numbers::pi / 180.0;
    const double diameter = *gear.module / std::cos(helix) * *gear.teeth;
    const double density = material_of(component, lookup_).density.value_or(density_);
    BodyMass hole;
    const auto bore = lookup_->number(component, "inner_diameter", RexsQuantity::length);
    const auto middle = gear.place;
    if (bore && *bore > 0.0) {
      hole = frustum(*gear.face_width, *bore, *bore, density);
    } else if (middle) {
      hole = filled(shaft_->sections, *middle - 0.5 * *gear.face_width,
                    *middle + 0.5 * *gear.face_width, density);
    }
    BodyMass body = minus(frustum(*gear.face_width, diameter, diameter, density), hole);
    const auto given = lookup_->number(component, "mass_of_component", RexsQuantity::mass);
    if (given && *given > 0.0 && body.mass > 0.0) {
      body = {*given, body.inertia * *given / body.mass};
    }
    if (!(body.mass > 0.0)) return;
    own->mass = body.mass;
    own->inertia = body.inertia;
    add(gear.name, body);
  }

  void add_masses() {
    for (const RexsComponent* one : lookup_->related(component_, "assembly", "assembly", "part")) {
      if (one->type != "additional_mass") continue;
      add(one->name,
          {lookup_->number(*one, "mass_of_component", RexsQuantity::mass).value_or(0.0),
           lookup_->number(*one, "moment_of_inertia_u_axis", RexsQuantity::inertia).value_or(0.0)});
    }
  }

 private:
  void add(const std::string& what, const BodyMass& body) {
    shaft_->mass += body.mass;
    shaft_->inertia += body.inertia;
    shaft_->bodies.push_back(
        fmt::format("{} {:.4g} kg, {:.4g} kg mm^2", what, body.mass, body.inertia));
  }

  const RexsComponent& component_;
  RexsLookup* lookup_;
  UnitShaft* shaft_;
  double density_ = kSteelDensity;
};

}  // namespace

std::optional<double> torsional_stiffness(const UnitShaft& shaft, double from, double to) {
  constexpr double kSteelShear = 8.1e4;  // N/mm^2
  constexpr double kGap = 1e-3;          // mm, of numbers that were rounded
  if (from > to) std::swap(from, to);
  std::vector<ShaftSection> sections = shaft.sections;
  std::ranges::sort(sections, {}, &ShaftSection::begin);
  double at = from, twist = 0.0;  // of N mm, up to there
  for (const ShaftSection& one : sections) {
    const double end = std::min(to, one.begin + one.length);
    if (end <= at + kGap) continue;
    if (one.begin > at + kGap) break;
    if (one.begin < at - kGap && at > from) return std::nullopt;  // two lie over each other
    twist += twist_of(one, at, end);
    at = end;
  }
  if (at < to - kGap || !(twist > 0.0)) return std::nullopt;
  return shaft.shear_modulus.value_or(kSteelShear) / twist * 1e-3;
}

BodyMass frustum(double length, double first, double last, double density) {
  const double a = first, b = last, per_mm3 = density * 1e-6;
  return {per_mm3 * std::numbers::pi * length / 12.0 * (a * a + a * b + b * b),
          per_mm3 * std::numbers::pi * length / 160.0 *
              (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b)};
}

void weigh_shaft(const RexsComponent& component,
                 const std::vector<std::pair<UnitGear*, const RexsComponent*>>& gears,
                 RexsLookup* lookup, UnitShaft* shaft) {
  ShaftScale scale(component, lookup, shaft);
  scale.add_sections();
  for (const auto& [gear, from] : gears) scale.add_gear(gear, *from);
  scale.add_masses();
}

}  // namespace gearsweep
