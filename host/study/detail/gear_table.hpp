// The [gear] table of a study: a gear pair in the units of a drawing, turned into the dimensionless
// parameters of the model gear5.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "study/detail/gear_keys.hpp"
#include "study/dynamic_factor.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The model whose parameters follow from the table.
const Model& gear_table_model();
// Whether it is this one, and no other of the same name.
bool is_gear_table_model(const Model& model);

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
  std::vector<std::string> notes;   // intermediate results, one line each
  std::vector<std::string> doubts;  // what is far from any gear, one line each, with the place
  Scales scales;
  std::optional<DynamicFactorInput> dynamic_factor;  // where the table has what K_v takes
};

// The keys are those of gear_keys.hpp and doc/gear.md; y is along the line of action, and the
// pinion drives. At a centre distance other than the standard one the gears work at the pressure
// angle cos(alpha_w) = (Rp + Rg)/a, which then stands for alpha everywhere. A given contact ratio
// changes the length of the path of contact, not its split at the pitch point. Lengths are scaled
// by the half backlash b_n, forces by k0 b_n, time by 1/varpi with varpi^2 = k0/me (Chen et al.
// 2011). Throws InputError with the place: unknown or missing keys, numbers out of range, a gear
// pair that the model cannot describe.
//
// values: numbers in place of those of the table, in the range of their keys.
GearConversion convert_gear(const toml::table& gear, const GearValues& values = {});

}  // namespace gearsweep
