// Where trajectories start: the [initial] table of a study.
#pragma once

#include <toml++/toml.h>

#include "study/study.hpp"

namespace gearsweep {

// `table` may be nullptr: all is as the preset has it. The model and the axes must have been read.
// Throws InputError.
void read_initial(const toml::table* table, Study* study);

}  // namespace gearsweep
