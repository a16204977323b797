// Places and ranges as text: --at NAME=VALUE, --along NAME=FROM:TO. All functions throw InputError.
#pragma once

#include <string>
#include <vector>

#include "orbits/orbit_findings.hpp"
#include "point/place.hpp"

namespace gearsweep {

// at: "omega=0.7" each.
Place read_place(const Study& study, const std::vector<std::string>& at);

// text: "omega=0.6:0.8".
FollowedRange read_range(const Model& model, const std::string& text);

}  // namespace gearsweep
