// What follows from a drawing for a model of a gear pair: parameters, curves, options and scales.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gear/datum.hpp"
#include "gear/drawing.hpp"
#include "gear/dynamic_factor.hpp"
#include "gear/scales.hpp"
#include "model/model.hpp"

namespace gearsweep {

// One parameter of the model. `note` says how the number came about, with units and the formula, as
// in "me/mp = 0.350752 kg / 1 kg".
struct GearParameter {
  std::string name;
  double value = 0.0;
  std::string note;
  std::string_view key;  // of the drawing, that gives it
};

// An option of the model that the drawing needs; a study may choose another.
struct GearOption {
  std::string name, choice;
};

// What is possible, but far from any gear: a line about a key of the drawing.
struct GearDoubt {
  std::string_view key;
  std::string text;
};

// Whether notes and data are written, too. Of the many drawings of an axis nobody reads them.
enum class GearTexts : std::uint8_t { all, none };

struct GearConversion {
  std::vector<GearParameter> parameters;  // each once; omega only when the pinion's speed is given
  std::vector<GearOption> options;
  Curves curves;
  std::vector<std::string> notes;  // intermediate results, one line each
  std::vector<GearDatum> data;     // what all numbers of the drawing rest on
  std::vector<GearDoubt> doubts;
  Scales scales;
  std::optional<DynamicFactorInput> dynamic_factor;  // where the drawing has what K_v takes
};

// y is along the line of action, and the pinion drives. At a centre distance other than the
// standard one the gears work at the pressure angle cos(alpha_w) = (Rp + Rg)/a, which then stands
// for alpha everywhere. A given contact ratio changes the length of the path of contact, not its
// split at the pitch point. Lengths are scaled by the half backlash b_n, forces by k0 b_n, time by
// 1/varpi with varpi^2 = k0/me (Chen et al. 2011). Throws DrawingError: missing keys, a gear pair
// that the model's ranges do not allow or that there cannot be, what the model does not have.
//
// The model may be any that calls what it takes as gear5 does, with the suffix: eps_first. It may
// take the bases of the drawing, too: k0 in N/m, b_n in m and varpi in rad/s.
GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const std::string& suffix = "", GearTexts texts = GearTexts::all);

// Whether the model has something of what the key gives where it stands in a drawing with this
// suffix; a drawing with other keys is refused.
bool takes_key(const Model& model, const std::string& suffix, const GearKey& key);

}  // namespace gearsweep
