// A model's header for the device compiler, written from its formula.
#pragma once

#include <string>

#include "equations/definition.hpp"
#include "equations/detail/lowering.hpp"
#include "equations/detail/tangent_program.hpp"

namespace gearsweep {

// Made of names that are checked and of parsed expressions alone: no text of a user's is in it but
// as those.
// is_rough: as in Model.
std::string kernel_of(const ModelDefinition& definition, Formula* formula, const Lowered& lowered,
                      const TangentProgram& tangent, bool is_rough);

}  // namespace gearsweep
