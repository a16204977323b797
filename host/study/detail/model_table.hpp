// The tables [model] and [parameters] of a study. All throw InputError with the place.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "study/study.hpp"

namespace gearsweep {

// The text of the model's file, and the numbers of the tables that it reads, become a part of the
// study, which needs no other file any more. source: the study's own file, which they lie beside.
void take_in_model_file(const std::string& source, toml::table* root);

// The model with the values of its preset, or of its defaults, and the options.
void read_model(const toml::table& root, const toml::table* table, Study* study);

void read_parameters(const toml::table* table, Study* study);

}  // namespace gearsweep
