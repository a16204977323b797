#include "equations/detail/linearization.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

class Elimination {
 public:
  Elimination(Formula* formula, const std::vector<NodeId>& outputs)
      : formula_(formula), graph_(&formula->graph), outputs_(outputs) {
    const std::vector<NodeId> nodes = parts_of(*graph_, outputs);
    for (const NodeId id : nodes) add(id);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (moves_.contains(outputs[i])) connect(output(i), outputs[i], graph_->number(1.0));
    }
  }

  Linearization run() {
    while (eliminate_best()) {
    }
    Linearization out;
    std::map<NodeId, std::size_t> places;
    for (std::size_t i = 0; i < formula_->states.size(); ++i) places[formula_->states[i]] = i;
    for (const NodeId id : moves_) {
      if (is_state(id) || !parents_.contains(id)) continue;
      out.parts.push_back(sum_of(id, places));
      places[id] = formula_->states.size() + out.parts.size() - 1;
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      out.outputs.push_back(sum_of(output(i), places));
    }
    return out;
  }

 private:
  using Vertex = std::uint64_t;  // a node, or an output

  static Vertex output(std::size_t index) { return (Vertex{1} << 32U) + index; }
  bool is_state(NodeId id) const {
    return std::ranges::find(formula_->states, id) != formula_->states.end();
  }

  // Arguments first, so that whether they move is known.
  void add(NodeId id) {
    if (is_state(id)) {
      moves_.insert(id);
      return;
    }
    const std::vector<NodeId> arguments = (*graph_)[id].arguments;
    const auto moves = [&](NodeId argument) { return moves_.contains(argument); };
    if (std::ranges::none_of(arguments, moves)) return;
    const std::vector<NodeId> partials = partial_derivatives(graph_, id);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (!moves(arguments[i]) || graph_->is_number(partials[i], 0.0)) continue;
      moves_.insert(id);
      connect(id, arguments[i], partials[i]);
    }
  }

  void connect(Vertex parent, NodeId child, NodeId coefficient) {
    const auto [edge, is_new] = children_[parent].try_emplace(child, coefficient);
    if (!is_new) edge->second = graph_->make(Operation::add, {edge->second, coefficient});
    parents_[child].insert(parent);
  }

  // Operations that eliminating it adds. The sum of a node takes one for each of its children, but
  // one less where a child is added as it is.
  int cost(NodeId id) const {
    const auto& children = children_.at(id);
    const auto& parents = parents_.at(id);
    int added = 0;
    for (const Vertex parent : parents) {
      for (const auto& [child, coefficient] : children) {
        if (!children_.at(parent).contains(child)) ++added;
      }
    }
    const bool begins_free =
        std::ranges::any_of(children, [&](const auto& edge) { return is_one(edge.second); });
    return added - static_cast<int>(children.size()) + (begins_free ? 1 : 0) -
           static_cast<int>(parents.size());
  }

  bool is_one(NodeId coefficient) const {
    return graph_->is_number(coefficient, 1.0) || graph_->is_number(coefficient, -1.0);
  }

  bool eliminate_best() {
    int least = 0;
    NodeId best = 0;
    for (const NodeId id : moves_) {
      if (is_state(id) || !parents_.contains(id)) continue;
      const int added = cost(id);
      if (added < least) {
        least = added;
        best = id;
      }
    }
    if (least < 0) eliminate(best);
    return least < 0;
  }

  void eliminate(NodeId id) {
    const std::map<NodeId, NodeId> children = children_.at(id);
    const std::set<Vertex> parents = parents_.at(id);
    for (const Vertex parent : parents) {
      const NodeId factor = children_.at(parent).at(id);
      children_.at(parent).erase(id);
      for (const auto& [child, coefficient] : children) {
        connect(parent, child, graph_->make(Operation::multiply, {factor, coefficient}));
      }
    }
    for (const auto& [child, coefficient] : children) parents_.at(child).erase(id);
    children_.erase(id);
    parents_.erase(id);
  }

  LinearSum sum_of(Vertex vertex, const std::map<NodeId, std::size_t>& places) const {
    LinearSum sum;
    const auto found = children_.find(vertex);
    if (found == children_.end()) return sum;
    for (const auto& [child, coefficient] : found->second) {
      sum.push_back({coefficient, places.at(child)});
    }
    return sum;
  }

  Formula* formula_;
  ExpressionGraph* graph_;
  const std::vector<NodeId> outputs_;
  std::set<NodeId> moves_;  // nodes that change with a state; arguments come first
  std::map<Vertex, std::map<NodeId, NodeId>> children_;  // with their coefficients
  std::map<NodeId, std::set<Vertex>> parents_;
};

}  // namespace

Linearization linearize(Formula* formula, const std::vector<NodeId>& outputs) {
  return Elimination(formula, outputs).run();
}

}  // namespace gearsweep
