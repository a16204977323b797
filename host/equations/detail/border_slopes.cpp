#include "equations/detail/border_slopes.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "equations/detail/border_quotients.hpp"
#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

// How much steeper each node is above a border, from the innermost one out.
class Steepness {
 public:
  Steepness(Formula* formula, const std::vector<NodeId>& equations, const Border& border)
      : graph_(&formula->graph),
        equations_(equations),
        border_(border),
        states_(states_of(*formula)),
        above_(graph_, border.above),
        below_(graph_, border.below),
        at_border_(graph_, {{border.lhs, border.rhs}}),
        quotients_(formula, border) {}

  std::optional<std::vector<NodeId>> run() {
    std::set<NodeId> sources;
    for (const auto& [node, side] : border_.above) sources.insert(node);
    for (const NodeId id : changed_by(*graph_, equations_, sources)) known_[id] = of(id);
    std::vector<NodeId> out;
    for (const NodeId row : equations_) {
      const auto found = known_.find(row);
      const std::optional<NodeId> steeper =
          found == known_.end() ? graph_->number(0.0) : found->second;
      if (!steeper) return std::nullopt;
      out.push_back(on_both_sides(*steeper));
    }
    return out;
  }

 private:
  std::optional<NodeId> of(NodeId id) {
    if (is_condition((*graph_)[id].operation)) return of_condition(id);
    if (const auto combined = by_arguments(id)) return combined;
    return quotients_.of(above_(id), below_(id));
  }

  // 0 where it stays what it is, though what it compares may bend.
  std::optional<NodeId> of_condition(NodeId id) {
    if (border_.above.contains(id)) return std::nullopt;
    for (const NodeId argument : (*graph_)[id].arguments) {
      const auto found = known_.find(argument);
      const bool changes = found != known_.end() && !found->second;
      if (changes && is_condition((*graph_)[argument].operation)) return std::nullopt;
    }
    return graph_->number(0.0);
  }

  // What is a number on one side of the border alone, as the root of lhs - rhs, is taken at it.
  NodeId on_both_sides(NodeId id) {
    const std::set<NodeId> changed = changed_by(*graph_, {id}, states_);
    const bool is_anywhere = std::ranges::none_of(changed, [&](NodeId part) {
      const Node& node = (*graph_)[part];
      switch (node.operation) {
        case Operation::power:
        case Operation::logarithm:
        case Operation::square_root:
        case Operation::square_root_above_one:
        case Operation::arcsine:
        case Operation::arccosine:
          return true;
        case Operation::divide:
          return changed.contains(node.arguments[1]);
        default:
          return false;
      }
    });
    return is_anywhere ? id : at_border_(below_(id));
  }

  // Where its arguments bend and the node itself does not.
  std::optional<NodeId> by_arguments(NodeId id) {
    if (border_.above.contains(id)) return std::nullopt;
    const std::vector<NodeId> arguments = (*graph_)[id].arguments;
    for (const NodeId argument : arguments) {
      const auto found = known_.find(argument);
      if (found != known_.end() && !found->second) return std::nullopt;
    }
    const std::vector<NodeId> partials = partial_derivatives(graph_, id);
    NodeId all = graph_->number(0.0);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const auto found = known_.find(arguments[i]);
      if (found == known_.end()) continue;
      const NodeId part = graph_->make(Operation::multiply, {partials[i], *found->second});
      all = graph_->make(Operation::add, {all, part});
    }
    return all;
  }

  ExpressionGraph* graph_;
  const std::vector<NodeId>& equations_;
  const Border& border_;
  const std::set<NodeId> states_;
  Rewriter above_, below_, at_border_;
  Quotients quotients_;
  std::map<NodeId, std::optional<NodeId>> known_;  // of what changes at the border
};

}  // namespace

std::optional<std::vector<NodeId>> steeper_above(Formula* formula,
                                                 const std::vector<NodeId>& equations,
                                                 const Border& border) {
  return Steepness(formula, equations, border).run();
}

}  // namespace gearsweep
