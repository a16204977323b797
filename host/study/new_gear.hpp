// A study of a gear pair that begins with its numbers of teeth.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace gearsweep {

struct NewGear {
  std::array<int, 2> teeth = {};
  double module_mm = 0.0;
  std::optional<double> face_width_mm, torque_N_m, helix_angle_deg;
};

// TOML that 'gearsweep run' takes, over speeds up to the resonance of the teeth or a pitch-line
// velocity of 50 m/s. What is not given is an estimate, and its comment says so; every other key of
// [gear] stands there as a comment. Throws InputError for gears that there cannot be.
std::string new_gear_study(const NewGear& gear);

}  // namespace gearsweep
