// [model.curves]: functions of the phase that a study binds to its model.
#pragma once

#include <toml++/toml.h>

#include "model/model.hpp"
#include "study/detail/study_files.hpp"

namespace gearsweep {

// stiffness = "k.csv" or { file = "k.csv", interpolation = "cubic" }: the numbers of the files
// become [model.tables], so that the study needs no other file any more. Throws InputError with the
// place.
void take_in_curve_files(const StudyFiles& files, toml::table* root);

// model: the table. Throws InputError for what is none of the model's curves, or not in its tables.
Curves read_given_curves(const toml::table* model, const Model& of);

}  // namespace gearsweep
