// The table [model] of a study. All throw InputError with the place.
#pragma once

#include <toml++/toml.h>

#include "study/detail/study_files.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The text of the model's file, and the numbers of the tables that it reads, become a part of the
// study, which needs no other file any more.
void take_in_model_file(const StudyFiles& files, toml::table* root);

// The model with the values of its preset, or of its defaults, and the options.
void read_model(const toml::table& root, const toml::table* table, Study* study);

}  // namespace gearsweep
