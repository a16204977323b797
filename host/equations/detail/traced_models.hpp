// The models that kernels/models/ has headers of, as graphs.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "equations/field_graph.hpp"

namespace gearsweep {

// By name: the graph of the header with its options chosen.
using TracedModels =
    std::map<std::string, std::function<FieldGraph(const std::vector<int>& options)>, std::less<>>;
const TracedModels& traced_models();

}  // namespace gearsweep
