// Where tangent vectors start, for every engine.
#pragma once

#include <cstddef>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// [vector][state]: orthonormal, and each leans on all states but the clocks (Model::clocks), so
// that none starts in a subspace that the motion keeps. They are rows of a Householder reflection.
// vectors <= model.perturbed_states().
std::vector<double> start_tangents(std::size_t vectors, const Model& model);

}  // namespace gearsweep
