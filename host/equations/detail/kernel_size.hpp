// How much a device's compiler is given.
#pragma once

#include <string>

#include "equations/definition.hpp"
#include "equations/detail/lowering.hpp"

namespace gearsweep {

// Throws InputError where the kernel of a model is beyond 4 MB, and names the equation or signal
// that makes most of it. A compiler takes time that grows faster than the text.
void refuse_large_kernel(const ModelDefinition& definition, const Formula& formula,
                         const Lowered& lowered, const std::string& kernel);

}  // namespace gearsweep
