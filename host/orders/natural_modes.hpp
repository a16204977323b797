// Natural frequencies of a model's linear system.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace gearsweep {

struct NaturalMode {
  double frequency = 0.0;  // rad per dimensionless time; without its damping, and forcing's for 1
  double damping = 0.0;    // ratio to the critical damping; below 1
};

// The modes that oscillate, slowest first, of small motions about the static equilibrium: from the
// model's Jacobian there, averaged over the phase, so with the mean stiffness. The frequency is the
// modulus of an eigenvalue. Equal ones stand as often as they are. Empty where nothing oscillates
// or the Jacobian is not finite.
std::vector<NaturalMode> natural_modes(const Model& model, const ModelSetting& setting);

}  // namespace gearsweep
