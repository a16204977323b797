// The [uncertain] table of a study.
#pragma once

#include <toml++/toml.h>

#include "study/detail/study_files.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Puts the numbers of files that the table names in their place, so that the text is whole. Throws
// InputError.
void take_in_sample_files(const StudyFiles& files, toml::table* study);

// Reads the table and makes the draws, and adds the maps of all draws to what is observed. The rest
// of the study is there. Throws InputError.
void read_uncertain(const toml::table& root, Study* study);

}  // namespace gearsweep
