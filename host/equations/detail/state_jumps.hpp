// Where a state makes a model's equations jump.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/lowering.hpp"
#include "model/model.hpp"

namespace gearsweep {

// "the equation of v, mine.model:12".
std::string equation_of(const ModelDefinition& definition, const RoughPlace& place);

std::vector<StateJump> state_jumps_of(const ModelDefinition& definition,
                                      const std::vector<RoughPlace>& places);

// Model::state_jumps; written: the formula before it was lowered.
std::function<std::vector<StateJump>(const ModelSetting&)> state_jumps_by_setting(
    const ModelDefinition& definition, const std::shared_ptr<const Formula>& written,
    const Lowered& lowered);

}  // namespace gearsweep
