// The pairs that a model's header declares.
#pragma once

#include <string_view>

#include "model/model.hpp"

namespace gearsweep {

// states, parameters: names, pair after pair.
MirrorPairs mirror_pairs_of(const Model& model, std::string_view states,
                            std::string_view parameters);

}  // namespace gearsweep
