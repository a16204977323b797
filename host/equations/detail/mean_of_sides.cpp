#include "equations/detail/mean_of_sides.hpp"

#include <algorithm>
#include <vector>

namespace gearsweep {
namespace {

std::vector<NodeId> used_by(const ExpressionGraph& graph, NodeId id,
                            const std::set<NodeId>& sides) {
  std::vector<NodeId> used = parts_of(graph, {id});
  std::erase_if(used, [&](NodeId part) { return !sides.contains(part); });
  return used;
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
  constexpr std::size_t kMost = 3;
  const std::vector<NodeId> used = used_by(*graph, signal, sides);
  if (used.empty() || sides.contains(signal)) return signal;
  const Node node = (*graph)[signal];
  const bool is_sum = node.operation == Operation::add || node.operation == Operation::subtract ||
                      node.operation == Operation::negate;
  const bool is_multiple = node.operation == Operation::multiply &&
                           std::ranges::any_of(node.arguments, [&](NodeId factor) {
                             return used_by(*graph, factor, sides).empty();
                           });
  if (is_sum || is_multiple) {
    std::vector<NodeId> arguments;
    for (const NodeId argument : node.arguments) {
      arguments.push_back(mean_of_sides(graph, argument, sides));
    }
    return graph->make(node.operation, arguments);
  }
  if (used.size() > kMost) return signal;
  for (const NodeId side : used) signal = mean_of_side(graph, signal, side);
  return signal;
}

}  // namespace gearsweep
