// The [gear] table of a study: a gear pair in the units of a drawing, turned into the dimensionless
// parameters of the model gear5.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/detail/gear_keys.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The model whose parameters follow from the table.
const Model& gear_table_model();

// One parameter of that model. `note` says how the number came about, with units and the formula,
// as in "me/mp = 0.350752 kg / 1 kg".
struct GearParameter {
  std::string name;
  double value = 0.0;
  std::string note;
  std::string key;  // of the table, that gives it
};

// An option of that model that the table needs; [model] may give another.
struct GearOption {
  std::string name, choice;
};

struct GearConversion {
  std::vector<GearParameter> parameters;  // each once; omega only when the pinion's speed is given
  std::vector<GearOption> options;
  Curves curves;
  std::vector<std::string> notes;  // intermediate results, one line each
  Scales scales;
};

// Keys of the table. Pairs are one number for both gears or [pinion, gear]; bearings are one number
// or [pinion x, pinion y, gear x, gear y], y along the line of action. The pinion drives.
//   teeth = [pinion, gear]      module_mm                    pressure_angle_deg (20)
//   centre_distance_mm (module (z1 + z2)/2)                  addendum_mm (pair; one module)
//   contact_ratio (from the geometry)                        inertia_kg_mm2 (pair)
//   mass_kg (pair)              bearing_stiffness_N_per_mm   bearing_damping_N_s_per_mm
//   mesh_damping_N_s_per_mm     half_backlash_mm (along the line of action)
//   mesh_stiffness_N_per_m or face_width_mm (mean stiffness k0 by ISO 6336-1, method B)
//   torque_N_m (on the pinion)  transmission_error_um (amplitudes of harmonics)
//   transmission_error_phase_deg   runout_um (pair)   runout_phase_deg (pair)   damage (pair)
//   pinion_speed_rpm (omega stays as it is)
// At a centre distance other than the standard one the gears work at the pressure angle
// cos(alpha_w) = (Rp + Rg)/a, which then stands for alpha everywhere. A given contact ratio changes
// the length of the path of contact, not its split at the pitch point. Lengths are scaled by the
// half backlash b_n, forces by k0 b_n, time by 1/varpi with varpi^2 = k0/me (Chen et al. 2011).
// Throws InputError with the place: unknown or missing keys, numbers out of range, a gear pair that
// the model cannot describe.
//
// values: numbers in place of those of the table, in the range of their keys.
GearConversion convert_gear(const toml::table& gear, const GearValues& values = {});

}  // namespace gearsweep
