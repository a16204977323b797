// What the files of [gear] have in common: the parameters that they give, the geometry of the pair,
// and what its equations are scaled by.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/detail/gear_files.hpp"
#include "study/detail/gear_keys.hpp"
#include "study/detail/gear_table.hpp"

namespace gearsweep {

// Collects the parameters; each is checked against the range that the model gives it.
class GearParameters {
 public:
  explicit GearParameters(const GearReader& in) : in_(in), model_(gear_table_model()) {}

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
struct GearGeometry {
  double pinion_teeth, gear_teeth, module;
  double pinion_base, gear_base;  // base radii Rp, Rg
  double alpha;                   // working pressure angle
  double normal_alpha;            // of the tool
  double centre;                  // centre distance
  double base_pitch;              // transverse, as all of these but the module
  double helix;                   // at the reference circle
  std::vector<double> shift;      // profile shift coefficients
  // Reference radii.
  double reference(double teeth) const { return module / std::cos(helix) * teeth / 2.0; }
  // The overlap ratio of a face width in mm.
  double overlap(double width) const {
    return width * std::sin(helix) / (std::numbers::pi * module);
  }
};

// By ISO 6336-1, how many times as stiff as one pair of teeth the mesh is in the mean, of a
// transverse contact ratio.
inline double pairs_in_mean(double contact_ratio) { return 0.75 * contact_ratio + 0.25; }

// What is possible, but far from any gear: a line each, with the place.
std::vector<std::string> doubts_about(GearReader& in, const GearGeometry& geometry);

// The path of contact on the line of action, in base pitches: from entry to the pitch point and on
// to exit.
struct ContactPath {
  double approach, recess;
  double contact_ratio() const { return approach + recess; }
};

// What the equations of motion are scaled by; SI units.
struct GearBases {
  double pinion_mesh_mass, gear_mesh_mass;  // I/R^2, kg
  double me;                                // kg
  double k0;                                // N/m
  double b_n;                               // m
  double varpi;                             // rad/s
  double pinion_base;                       // Rp, m
};

// Within a part in a million of the standard centre distance the tool's pressure angle is kept, so
// that a rounded drawing gives the same gear as no centre distance at all.
GearGeometry read_geometry(GearReader& in);

// Adds eps and approach; returns the path of contact in use.
ContactPath read_path(GearReader& in, const GearGeometry& geometry, GearParameters* parameters,
                      std::vector<std::string>* notes);

// Adds the transmission error, with what the profile's deviations make of it. Returns whether one
// sine is enough.
bool add_transmission_error(GearReader& in, const GearGeometry& geometry, const ContactPath& path,
                            const GearBases& bases, GearParameters* parameters,
                            std::vector<std::string>* notes);

// What the dynamic factor of ISO 6336-1 takes; nothing where the table has no deviations.
std::optional<DynamicFactorInput> read_dynamic_factor(GearReader& in, const GearGeometry& geometry,
                                                      const ContactPath& path,
                                                      const GearBases& bases,
                                                      std::vector<std::string>* notes);

// What comes back once per turn of a gear. Returns whether there is any runout or pitch error.
bool add_faults(GearReader& in, const GearGeometry& geometry, const GearBases& bases,
                GearParameters* parameters, Curves* curves);

// The measured stiffness, if there is one.
void add_stiffness(GearReader& in, const std::optional<MeasuredCurve>& stiffness,
                   Interpolation interpolation, const GearBases& bases, GearConversion* out);

}  // namespace gearsweep
