// The reference engine's own opinion of where the equations jump in a period.
#pragma once

#include <cstddef>

#include "plan/phase_grid.hpp"

namespace gearsweep {

// The grid of phases that the model gives, with steps that end, too, where its coefficients are
// seen to jump or bend and the model does not say so: close phases are compared. Such a phase, if
// there is one, makes the results of the engines differ. Of a model that is given as equations; of
// others what the model gives.
PhaseGrid scanned_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps);

}  // namespace gearsweep
