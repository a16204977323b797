// The phases at which a model's steps end: those that its file lists and those that are found in
// its equations. The list is a promise that is compared.
#pragma once

#include <string>
#include <vector>

#include "equations/detail/tapes.hpp"

namespace gearsweep {

// In [0, 1), not sorted. What the file lists stands as it is: rounding may have found it a little
// elsewhere. Throws InputError that names the file where there are too many.
std::vector<double> break_phases_of(const Tapes& tapes, const ModelSetting& setting);

// Jumps that are found and not listed, and listed and not found, each in a sentence. A model that
// lists none promises nothing.
std::vector<std::string> broken_promises(const Tapes& tapes, const ModelSetting& setting);

}  // namespace gearsweep
