// The known answers of a model's file.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// [[answers]] of the file that the model is made of; none where it has none. Throws InputError.
std::vector<KnownAnswer> read_answers(const toml::table& root, const Model& model);

}  // namespace gearsweep
