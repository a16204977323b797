// What a model that can be parsed may not say. All throw InputError with the place.
#pragma once

#include "equations/definition.hpp"
#include "equations/detail/formula.hpp"

namespace gearsweep {

// A state that counts within one turn must not tell one turn from the next.
void refuse_unrolled_angles(const ModelDefinition& definition, Formula* formula);
// Nothing comes to a surface or a section whose level no state changes, or whose level jumps.
void refuse_unreached_places(const ModelDefinition& definition, Formula* formula);
// Where mirrored states begin, they must mirror each other while their parameters are equal.
// formula: without derived parameters, of which it would not have the symbols.
void refuse_unmirrored_starts(const ModelDefinition& definition, Formula* formula);

// Whether there is a phase in its equations, or wherever else a motion is made or looked at.
bool has_phase(const Formula& formula);
void refuse_phase_without_clock(const ModelDefinition& definition, const Formula& formula);

}  // namespace gearsweep
