// Models of equations as headers that were written by hand, before they became files.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace gearsweep {

const std::vector<Model>& handwritten_models();

}  // namespace gearsweep
