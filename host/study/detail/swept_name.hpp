// The name of what a study sweeps.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <utility>

#include "study/study.hpp"

namespace gearsweep {

// Fills in what the parameter or state of this name has; its allowed range. what: "axis", for
// messages. Throws InputError when there is none.
std::pair<double, double> bind_swept(const Model& model, const toml::node& place,
                                     const std::string& what, Swept* swept);

}  // namespace gearsweep
