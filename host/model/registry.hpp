// What kernels/ has headers of: models, and observables (observable.hpp).
#pragma once

#include <vector>

#include "model/model.hpp"
#include "model/observable.hpp"

namespace gearsweep {

// Other models are files of equations (study/builtin_models.hpp).
const std::vector<Model>& header_models();

}  // namespace gearsweep
