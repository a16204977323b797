#include "equations/detail/borders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

class BorderFinder {
 public:
  BorderFinder(Formula* formula, const std::vector<NodeId>& equations)
      : graph_(&formula->graph),
        equations_(equations),
        with_state_(changed_by(*graph_, equations, states_of(*formula))) {}

  std::vector<Border> run() {
    for (const NodeId id : parts_of(*graph_, equations_)) {
      if (with_state_.contains(id)) look_at(id);
    }
    std::vector<Border> borders;
    for (auto& [place, border] : borders_) {
      border.above.insert(never_.begin(), never_.end());
      border.below.insert(never_.begin(), never_.end());
      borders.push_back(std::move(border));
    }
    return borders;
  }

 private:
  NodeId number(double value) { return graph_->number(value); }

  void look_at(NodeId id) {
    const Node node = (*graph_)[id];  // a copy: the graph grows
    const auto argument = [&](std::size_t i) { return node.arguments[i]; };
    switch (node.operation) {
      case Operation::less:
      case Operation::less_or_equal:
        return add(id, argument(0), argument(1), number(0.0), number(1.0));
      case Operation::equal:
        never_[id] = number(0.0);
        return;
      case Operation::sign:
        return add(id, argument(0), number(0.0), number(1.0), number(-1.0));
      case Operation::absolute:
        return add(id, argument(0), number(0.0), argument(0),
                   graph_->make(Operation::negate, {argument(0)}));
      case Operation::square_root: {  // of a square: abs
        const Node square = (*graph_)[argument(0)];
        if (square.operation != Operation::multiply) return;
        const NodeId root = square.arguments[0];
        if (square.arguments[1] != root) return;
        return add(id, root, number(0.0), root, graph_->make(Operation::negate, {root}));
      }
      case Operation::min:
        return add(id, argument(0), argument(1), argument(1), argument(0));
      case Operation::max:
        return add(id, argument(0), argument(1), argument(0), argument(1));
      case Operation::floor: {
        if (is_taken_in_turns(graph_, equations_, id, 1.0)) return;
        const NodeId below = graph_->symbol(fmt::format("whole[{}]", id));
        const NodeId above = graph_->make(Operation::add, {below, number(1.0)});
        return add(id, argument(0), above, above, below);
      }
      case Operation::arctangent_of_two:  // jumps by a turn where its second argument is below 0
        if (is_taken_in_turns(graph_, equations_, id, 2.0 * std::numbers::pi)) return;
        return add(id, argument(0), number(0.0), number(std::numbers::pi),
                   number(-std::numbers::pi));
      default:
        return;
    }
  }

  void add(NodeId id, NodeId lhs, NodeId rhs, NodeId above, NodeId below) {
    if (graph_->is_number(lhs) && !graph_->is_number(rhs)) return add(id, rhs, lhs, below, above);
    const Node left = (*graph_)[lhs];
    if (graph_->is_number(rhs, 0.0) && left.operation == Operation::negate) {
      return add(id, left.arguments[0], rhs, below, above);
    }
    if (graph_->is_number(rhs, 0.0) && left.operation == Operation::subtract) {
      return add(id, left.arguments[0], left.arguments[1], above, below);
    }
    if (const double factor = number_factor(left); graph_->is_number(rhs) && factor != 1.0) {
      const NodeId of = left.arguments[graph_->is_number(left.arguments[0]) ? 1 : 0];
      const NodeId limit = number((*graph_)[rhs].number / factor);
      if (factor < 0.0) std::swap(above, below);
      return add(id, of, limit, above, below);
    }
    const bool has_state_left = with_state_.contains(lhs),
               has_state_right = with_state_.contains(rhs);
    if (!has_state_left && !has_state_right) return;
    if (!has_state_left || (has_state_right && rhs < lhs)) {
      std::swap(lhs, rhs);
      std::swap(above, below);
    }
    Border& border = borders_[{lhs, rhs}];
    border.lhs = lhs;
    border.rhs = rhs;
    border.above[id] = above;
    border.below[id] = below;
  }

  // c of c*x and of x/(1/c), numbers that products with other numbers take up; 1 of all else.
  double number_factor(const Node& node) const {
    const auto usable = [](double factor) {
      return factor != 0.0 && std::isfinite(factor) ? factor : 1.0;
    };
    if (node.operation == Operation::multiply) {
      for (const NodeId argument : node.arguments) {
        if (graph_->is_number(argument)) return usable((*graph_)[argument].number);
      }
    }
    if (node.operation == Operation::divide && graph_->is_number(node.arguments[1])) {
      return usable(1.0 / (*graph_)[node.arguments[1]].number);
    }
    return 1.0;
  }

  ExpressionGraph* graph_;
  const std::vector<NodeId>& equations_;
  const std::set<NodeId> with_state_;
  std::map<std::pair<NodeId, NodeId>, Border> borders_;
  std::map<NodeId, NodeId> never_;  // conditions that hold for a moment only
};

}  // namespace

std::set<NodeId> changed_by(const ExpressionGraph& graph, const std::vector<NodeId>& roots,
                            const std::set<NodeId>& sources) {
  std::set<NodeId> changed;
  for (const NodeId id : parts_of(graph, roots)) {
    const bool changes =
        sources.contains(id) || std::ranges::any_of(graph[id].arguments, [&](NodeId argument) {
          return changed.contains(argument);
        });
    if (changes) changed.insert(id);
  }
  return changed;
}

std::set<NodeId> states_of(const Formula& formula) {
  return {formula.states.begin(), formula.states.end()};
}

bool is_taken_in_turns(ExpressionGraph* graph, const std::vector<NodeId>& roots, NodeId id,
                       double jump) {
  const std::set<NodeId> above = changed_by(*graph, roots, {id});
  const auto is_round = [&](NodeId parent) {
    const Node node = (*graph)[parent];
    const bool turns = node.operation == Operation::sine || node.operation == Operation::cosine ||
                       node.operation == Operation::tangent;
    if (!turns || !above.contains(parent)) return false;
    const NodeId slope = derivative(graph, node.arguments[0], id);
    if (!graph->is_number(slope)) return false;
    const double count = (*graph)[slope].number * jump / (2.0 * std::numbers::pi);
    return std::fabs(count - std::round(count)) < 1e-12 * (1.0 + std::fabs(count));
  };
  std::set<NodeId> open(roots.begin(), roots.end());
  while (!open.empty()) {
    const NodeId next = *open.rbegin();
    open.erase(next);
    if (next == id) return false;
    if (!above.contains(next) || is_round(next)) continue;
    for (const NodeId argument : (*graph)[next].arguments) open.insert(argument);
  }
  return true;
}

std::vector<Border> find_borders(Formula* formula, const std::vector<NodeId>& equations) {
  return BorderFinder(formula, equations).run();
}

}  // namespace gearsweep
