// Whether the orbits of a study have multipliers.
#pragma once

#include "study/study.hpp"

namespace gearsweep {

// Throws InputError for a model with two frequencies, whose motions do not return, and for one that
// jumps with a state where tangents miss it.
void require_multipliers(const Study& study);

}  // namespace gearsweep
