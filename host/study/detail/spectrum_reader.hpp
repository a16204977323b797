// A list of points whose column time_share makes it a load spectrum.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// For a study whose axes were read; shares that do not add up to 1 are divided by their sum, which
// a notice tells. Throws InputError for shares that are none, and for an axis beside the list.
void read_spectrum(const toml::table& root, Study* study);

// What a spectrum is judged by, as far as the model has it: forces, load factors and contact. What
// its study computes where it names nothing.
std::vector<std::string> spectrum_quantities(const Model& model);

}  // namespace gearsweep
