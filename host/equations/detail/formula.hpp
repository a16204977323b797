// The expressions of a model, parsed.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equations/definition.hpp"
#include "expression/expression.hpp"
#include "expression/print.hpp"

namespace gearsweep {

// Symbols are the names of states and parameters, `phase`, in radians, and `turn`.
struct Formula {
  ExpressionGraph graph;
  std::vector<NodeId> states, parameters;  // symbols
  // Symbols, of all options one after the other: 1 of the choice that is made, otherwise 0.
  std::vector<NodeId> choices;
  std::vector<bool> are_swept;                          // [parameter]: whether points differ in it
  std::vector<bool> are_negative;                       // [parameter]: whether it may be
  std::vector<std::pair<std::size_t, NodeId>> derived;  // parameters, and what they come to
  // By name; derived parameters are among them, since what uses one has its expression.
  std::vector<std::pair<std::string, NodeId>> constants;
  NodeNames names;  // of those that are more than a number or a symbol, once they are simplified
  NodeId phase = 0;
  std::optional<NodeId> turn;  // of a model with a cycle
  std::vector<NodeId> equations, start, signals, jumps;
  struct Impact {
    std::string name;
    NodeId when = 0;
    std::vector<NodeId> reset;  // [state]
  };
  std::vector<Impact> impacts;  // of the definition's surfaces
  struct Section {
    NodeId value = 0;
    bool of_rate = false, is_down = false;
  };
  std::vector<Section> sections;  // of the definition
  NodeId period = 0, cycle = 0;   // of the whole cycle; how many times the phase begins anew in it
  std::vector<NodeId> checks;     // conditions, as numbers that are 1 where they hold
  std::vector<std::vector<NodeId>> check_values;  // [check]: those that its message has
  std::vector<UnusedName> unused;
};

// Throws InputError.
Formula parse_formula(const ModelDefinition& definition);

}  // namespace gearsweep
