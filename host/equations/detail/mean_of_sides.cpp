#include "equations/detail/mean_of_sides.hpp"

#include <map>
#include <vector>

#include "equations/detail/borders.hpp"

namespace gearsweep {
namespace {

// Whether its mean is the same operation on the means of its arguments.
bool is_linear(const Node& node, const std::set<NodeId>& jumping) {
  switch (node.operation) {
    case Operation::add:
    case Operation::subtract:
    case Operation::negate:
      return true;
    case Operation::multiply:
      return !jumping.contains(node.arguments[0]) || !jumping.contains(node.arguments[1]);
    default:
      return false;
  }
}

// Whole numbers of a side are its values; between them it is their mean.
NodeId mean_of_side(ExpressionGraph* graph, NodeId id, NodeId side) {
  const NodeId low = graph->make(Operation::floor, {side});
  const NodeId high = graph->make(Operation::add, {low, graph->number(1.0)});
  const NodeId share = graph->make(Operation::subtract, {side, low});
  const NodeId at_low = Rewriter(graph, {{side, low}})(id);
  const NodeId at_high = Rewriter(graph, {{side, high}})(id);
  const NodeId more = graph->make(Operation::multiply,
                                  {share, graph->make(Operation::subtract, {at_high, at_low})});
  const NodeId slides = graph->make(Operation::less, {graph->number(0.0), share});
  return graph->make(Operation::select,
                     {slides, graph->make(Operation::add, {at_low, more}), at_low});
}

}  // namespace

NodeId mean_of_sides(ExpressionGraph* graph, NodeId signal, const std::set<NodeId>& sides) {
  const std::set<NodeId> jumping = changed_by(*graph, {signal}, sides);
  const std::vector<NodeId> parts = parts_of(*graph, {signal});
  std::set<NodeId> terms = {signal};
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const Node& node = (*graph)[*part];
    if (!terms.contains(*part) || !is_linear(node, jumping)) continue;
    terms.insert(node.arguments.begin(), node.arguments.end());
  }
  std::map<NodeId, NodeId> means;
  for (const NodeId part : parts) {
    if (!terms.contains(part)) continue;
    NodeId mean = part;
    const Node node = (*graph)[part];
    if (jumping.contains(part) && !sides.contains(part) && is_linear(node, jumping)) {
      std::vector<NodeId> arguments;
      for (const NodeId argument : node.arguments) arguments.push_back(means.at(argument));
      mean = graph->make(node.operation, arguments);
    } else if (jumping.contains(part) && !sides.contains(part)) {
      for (const NodeId inner : parts_of(*graph, {part})) {
        if (sides.contains(inner)) mean = mean_of_side(graph, mean, inner);
      }
    }
    means[part] = mean;
  }
  return means.at(signal);
}

}  // namespace gearsweep
