// What a study may ask of a model whose equations jump with a state, or bend where steps are not
// corrected.
#pragma once

#include <toml++/toml.h>

#include "study/study.hpp"

namespace gearsweep {

// Sets the study's accuracy, and for a jump takes away what rests on fourth order and on tangents:
// the stop on an orbit, and the pilot run. Throws InputError for quantities and tolerances that
// rest on them. `root` is all of the study's text, which has been read.
void heed_rough_model(const toml::table& root, Study* study);

}  // namespace gearsweep
