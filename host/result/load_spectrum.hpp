// What a load spectrum comes to: the answers of its loads, weighted by the time that each lasts,
// and the load that would do the same damage.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.hpp"

namespace gearsweep {

// What becomes of a force between teeth. NaN where a load that lasts has no value. A load of 0 has
// no load factor: the factor is that of the time under load.
struct SpectrumForce {
  std::string factor;    // the quantity: dynamic_load_factor
  std::size_t load = 0;  // the parameter
  double mean_factor = 0.0, max_factor = 0.0;
  std::size_t max_point = 0;  // of the largest factor
  // The load that does the same damage in the same number of mesh cycles, by Miner's rule with the
  // spectrum's slope p: (sum n_i F_i^p / sum n_i)^(1/p), n_i the cycles of a load (ISO 6336-6,
  // Annex A). Of the mean loads, and of the largest forces under each. In the model's unit.
  double equivalent_load = 0.0, equivalent_force = 0.0;
  std::vector<double> damage;  // [point] what each does of the damage of the largest forces
};

struct SpectrumAnswers {
  std::vector<SpectrumForce> forces;
  // The share of time under loads at which teeth part, in some contact; nothing where the study
  // does not look at contact.
  std::optional<double> parting_share;
  std::vector<std::size_t> parting;  // those points
  std::vector<std::size_t> failed;   // points that last and have no values
};

// For a study with a spectrum. The load factors that it computes say which forces there are.
SpectrumAnswers spectrum_answers(const SweepResult& result);

// The torque in N m that makes a mean load of 1, where the list has a column torque_N_m, or one of
// a drawing of several.
std::optional<double> torque_per_load(const Study& study, const SpectrumForce& force);

}  // namespace gearsweep
