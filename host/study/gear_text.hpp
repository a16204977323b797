// The text of a study that is begun for somebody: its drawings, with every key explained.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gearsweep {

struct GearTextKey {
  std::string value;   // as TOML has it
  std::string origin;  // for its comment: "ESTIMATE: ten modules"; empty: somebody gave it
};
using GearTextKeys = std::map<std::string_view, GearTextKey>;

// A load of a spectrum: N m, rpm, share of the time.
struct GearTextLoad {
  double torque = 0.0, speed = 0.0, share = 0.0;
};

struct GearText {
  std::string title;
  std::string about;  // lines, which become a comment at the top
  GearTextKeys keys;  // by the names of drawing_keys.hpp
  std::array<int, 2> teeth = {};
  double module_mm = 0.0;
  std::optional<double> face_width_mm;
  double fastest_rpm = 0.0;                   // of the pinion, that the axis has to reach
  std::vector<GearTextLoad> spectrum;         // in place of that axis
  std::map<std::string, std::string> tables;  // the numbers of files that keys name
};

// TOML that 'gearsweep run' takes, over speeds up to the resonance of the teeth or a pitch-line
// velocity of 50 m/s. What the keys do not have and a study needs is an estimate, and its comment
// says so; every other key of [gear] stands there as a comment. Throws InputError for gears that
// there cannot be. source: what messages call the text.
std::string gear_text(GearText text, const std::string& source);

struct UnitTextParameter {
  std::string name;
  std::string value, origin;  // of its comment
  bool is_default = false;    // it stands behind a #
};

// The text for a model with several drawings.
struct UnitText {
  std::string title, about;
  std::string model;                                         // of the zoo
  std::vector<std::pair<std::string, std::string>> options;  // of the model
  std::vector<std::pair<std::string, GearText>> drawings;    // by the model's names; title and
                                                             // about of each are not used
  std::vector<UnitTextParameter> parameters;                 // of the model
};

// The same of such a model, over speeds of the first drawing's pinion. It observes load factors,
// forces and contact. Throws InputError for gears that the model refuses, too.
std::string unit_text(UnitText text, const std::string& source);

}  // namespace gearsweep
