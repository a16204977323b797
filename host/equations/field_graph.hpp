// A model's right-hand side and signals as nodes of a graph: which states enter what, and how, is
// read there. Nothing is found by trying numbers.
#pragma once

#include <vector>

#include "expression/expression.hpp"
#include "model/model.hpp"

namespace gearsweep {

// Symbols other than these stand for what changes with the phase.
struct FieldGraph {
  ExpressionGraph graph;
  std::vector<NodeId> states, parameters;  // symbols, in the model's order
  // Symbols, of all options one after the other: 1 of the choice that is made, otherwise 0. Empty
  // where the choices are made already.
  std::vector<NodeId> choices;
  std::vector<NodeId> rates;    // [state]: dx/dtau
  std::vector<NodeId> signals;  // [signal]
};

// The graph of a whole model, simplified, with its options chosen (ModelSetting::options).
FieldGraph field_of(const Model& model, const std::vector<int>& options);

// The places among `symbols` of those that these nodes are made of.
std::vector<std::size_t> symbols_in(const ExpressionGraph& graph, const std::vector<NodeId>& nodes,
                                    const std::vector<NodeId>& symbols);

}  // namespace gearsweep
