// Where tangent vectors start, for every engine.
#pragma once

#include <cstddef>
#include <vector>

namespace gearsweep {

// [vector][state]: orthonormal, and each leans on all states, so that none starts in a subspace
// that the motion keeps. They are rows of a Householder reflection. vectors <= states.
std::vector<double> start_tangents(std::size_t vectors, std::size_t states);

}  // namespace gearsweep
