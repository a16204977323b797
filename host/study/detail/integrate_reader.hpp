// The table [integrate] of a study.
#pragma once

#include <toml++/toml.h>

#include "study/study.hpp"

namespace gearsweep {

// Takes the table into the study, whose model, axes and starts are read already. table: null where
// the study has none. `diverged_above` belongs to the model and is read with it.
void read_integrate(const toml::table* table, Study* study);

}  // namespace gearsweep
