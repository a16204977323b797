// The dynamic factor K_v of a gear pair by ISO 6336-1:2006, method B (6.5), which a report puts
// beside the dynamic load factor of a sweep. It counts with the largest force of the meshing teeth
// in a straight line between resonances, and knows of no lost contact.
#pragma once

#include <optional>

namespace gearsweep {

// What it takes of a pair of steel gears with case-hardened or nitrided flanks.
struct DynamicFactorInput {
  double single_stiffness = 0.0;     // c' of one pair of teeth, N/(mm um)
  double contact_ratio = 0.0;        // eps_gamma, above 1: transverse and overlap
  double pitch_deviation = 0.0;      // f_pb of the base pitch, um
  double profile_deviation = 0.0;    // f_falpha of the profile's form, um
  std::optional<double> tip_relief;  // C_a, um; none: the standard's value of grade 6 and worse
  double line_load_per_load = 0.0;   // line load in N/mm where the mean load is 1
  double resonance = 1.0;            // the mesh frequency at which N is 1, in varpi
};

// The part of a deviation that running-in leaves, both in um.
double run_in_deviation(double deviation);

// line_load: K_A F_t/b in N/mm, F_t at the reference circle. resonance_ratio: N, the speed by that
// at which the mesh frequency meets sqrt(c_gamma/m_red).
// NaN without a load.
double dynamic_factor(const DynamicFactorInput& pair, double line_load, double resonance_ratio);

}  // namespace gearsweep
