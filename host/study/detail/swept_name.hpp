// The name of what a study sweeps.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <utility>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// Fills in what the parameter or state of this name has; its allowed range. what: "axis", for
// messages; keys: names of [gear] that the study might have meant. Throws InputError when there is
// none.
std::pair<double, double> bind_swept(const Model& model, const toml::node& place,
                                     const std::string& what, Swept* swept,
                                     const std::vector<std::string>& keys = {});

// Throws InputError where the name is that of a constant, which has no value to give: plain numbers
// among them are parameters by now.
void refuse_fixed_constant(const Model& model, const toml::node& place, const std::string& name);

}  // namespace gearsweep
