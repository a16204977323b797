// Tolerances of the flanks of one gear by ISO 1328-1:2013, clause 5.3, and of its runout by annex
// E. The editions of 1995 and ISO 1328-2:1997 have other formulas and other numbers.
#pragma once

#include <optional>

namespace gearsweep {

// The gear and its class.
struct ToleranceClassInput {
  double reference_diameter = 0.0;  // d, 5 to 15,000 mm
  double normal_module = 0.0;       // m_n, 0.5 to 70 mm
  int tolerance_class = 0;          // A, 1 to 11
};

// All in um, rounded as the standard asks for.
struct FlankTolerances {
  double single_pitch = 0.0;   // f_pT, each way
  double total_pitch = 0.0;    // F_pT
  double profile_slope = 0.0;  // f_HalphaT, each way
  double profile_form = 0.0;   // f_falphaT
  double profile_total = 0.0;  // F_alphaT
  double runout = 0.0;         // F_rT
};

// Nothing outside of the ranges above, for which the standard gives no tolerances.
std::optional<FlankTolerances> flank_tolerances(const ToleranceClassInput& gear);

}  // namespace gearsweep
