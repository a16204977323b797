// Border curves over a map.
#pragma once

#include <string>

#include "plot/detail/picture.hpp"

namespace gearsweep {

// Adds the curves of a file, and what they are to the key. map_path: of the picture's own map.
// Throws InputError when the file holds no curves, or those of another plane.
void add_curves(const std::string& path, const std::string& map_path, Picture* picture);

}  // namespace gearsweep
