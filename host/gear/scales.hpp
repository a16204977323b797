// What the equations of a gear pair are scaled by.
#pragma once

namespace gearsweep {

// Lengths are in half backlashes b_n, forces in k0 b_n, time in 1/varpi with varpi^2 = k0/me. All
// zero where there is no drawing.
struct Scales {
  double varpi = 0.0;          // rad/s
  double b_n = 0.0;            // m
  double k0 = 0.0;             // N/m
  double rpm_per_omega = 0.0;  // pinion speed in rpm at omega = 1
  bool known() const { return varpi > 0.0; }
  bool operator==(const Scales&) const = default;
};

}  // namespace gearsweep
