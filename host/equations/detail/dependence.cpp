#include "equations/detail/dependence.hpp"

#include <algorithm>
#include <cstddef>

namespace gearsweep {
namespace {

bool rounds(Operation operation) {
  switch (operation) {
    case Operation::power:
    case Operation::sine:
    case Operation::cosine:
    case Operation::tangent:
    case Operation::arcsine:
    case Operation::arccosine:
    case Operation::arctangent:
    case Operation::arctangent_of_two:
    case Operation::hyperbolic_sine:
    case Operation::hyperbolic_cosine:
    case Operation::hyperbolic_tangent:
    case Operation::exponential:
    case Operation::logarithm:
      return true;
    default:
      return false;
  }
}

}  // namespace

const Dependence& Dependences::of(NodeId id) {
  const auto known = known_.find(id);
  if (known != known_.end()) return known->second;
  const Node& node = formula_.graph[id];
  Dependence found;
  if (node.operation == Operation::symbol) found = of_symbol(id);
  // At a fixed place, too: so it is tabulated, and no device sees it.
  found.phase |= node.operation == Operation::table;
  found.rounds |= rounds(node.operation);
  for (const NodeId argument : node.arguments) {
    const Dependence& below = of(argument);
    found.state |= below.state;
    found.velocity |= below.velocity;
    found.phase |= below.phase;
    found.swept |= below.swept;
    found.rounds |= below.rounds;
  }
  return known_.emplace(id, found).first->second;
}

Dependence Dependences::of_symbol(NodeId id) const {
  Dependence found;
  found.phase = id == formula_.phase || id == formula_.turn;
  const auto state = std::ranges::find(formula_.states, id);
  found.state = state != formula_.states.end() || std::ranges::find(sides_, id) != sides_.end();
  const auto number = static_cast<std::size_t>(state - formula_.states.begin());
  found.velocity = has_velocities_ && found.state && number >= formula_.states.size() / 2;
  found.swept = !found.phase && !found.state && is_swept(id);
  return found;
}

bool Dependences::is_swept(NodeId id) const {
  if (std::ranges::find(formula_.choices, id) != formula_.choices.end()) return false;
  const auto parameter = std::ranges::find(formula_.parameters, id);
  return parameter == formula_.parameters.end() ||
         formula_.are_swept[static_cast<std::size_t>(parameter - formula_.parameters.begin())];
}

}  // namespace gearsweep
