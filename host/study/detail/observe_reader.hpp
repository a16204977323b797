// The table [observe] of a study.
#pragma once

#include <toml++/toml.h>

#include "study/study.hpp"

namespace gearsweep {

// Takes the table into the study, whose model, axes and steps are read already. table: null where
// the study has none; root: the whole study, for messages.
void read_observe(const toml::table* table, const toml::table& root, Study* study);

}  // namespace gearsweep
