#include "equations/detail/border_quotients.hpp"

#include <cmath>
#include <limits>

#include "expression/differentiate.hpp"

namespace gearsweep {

Quotients::Quotients(Formula* formula, const Border& border)
    : graph_(&formula->graph),
      states_(states_of(*formula)),
      border_(border),
      at_border_(graph_, {{border.lhs, border.rhs}}),
      one_way_(make(Operation::subtract, border.lhs, border.rhs)),
      other_way_(make(Operation::subtract, border.rhs, border.lhs)) {}

std::optional<NodeId> Quotients::of(NodeId a, NodeId b) {
  const auto known = known_pairs_.find({a, b});
  if (known != known_pairs_.end()) return known->second;
  const std::optional<NodeId> found = look(a, b);
  known_pairs_.emplace(std::pair(a, b), found);
  return found;
}

std::optional<NodeId> Quotients::look(NodeId a, NodeId b) {
  const Node one = (*graph_)[a], other = (*graph_)[b];
  for (const Node* chosen : {&one, &other}) {
    if (chosen->operation != Operation::select) continue;
    // Near the border, a choice that is made there is made.
    const NodeId made = at_border_(chosen->arguments[0]);
    if (graph_->is_number(made)) {
      const NodeId branch = chosen->arguments[graph_->is_number(made, 0.0) ? 2 : 1];
      return chosen == &one ? of(branch, b) : of(a, branch);
    }
    const auto branch = [&](const Node& node, NodeId id, std::size_t which) {
      const bool is_split =
          node.operation == Operation::select && node.arguments[0] == chosen->arguments[0];
      return is_split ? node.arguments[which] : id;
    };
    const auto yes = of(branch(one, a, 1), branch(other, b, 1));
    const auto no = of(branch(one, a, 2), branch(other, b, 2));
    if (!yes || !no) return std::nullopt;
    return graph_->make(Operation::select, {chosen->arguments[0], *yes, *no});
  }
  return of(make(Operation::subtract, a, b));
}

std::optional<Quotients::Line> Quotients::line_of(NodeId id) {
  const auto known = lines_.find(id);
  if (known != lines_.end()) return known->second;
  const std::optional<Line> found = look_for_line(id);
  lines_.emplace(id, found);
  return found;
}

std::optional<Quotients::Line> Quotients::look_for_line(NodeId id) {
  if (id == border_.lhs) return Line{1.0, 0.0};
  const Node node = (*graph_)[id];
  if (node.operation == Operation::number) return Line{0.0, node.number};
  std::vector<Line> of;
  for (const NodeId argument : node.arguments) {
    const std::optional<Line> line = line_of(argument);
    if (!line) return std::nullopt;
    of.push_back(*line);
  }
  switch (node.operation) {
    case Operation::negate:
      return Line{-of[0].slope, -of[0].offset};
    case Operation::add:
      return Line{of[0].slope + of[1].slope, of[0].offset + of[1].offset};
    case Operation::subtract:
      return Line{of[0].slope - of[1].slope, of[0].offset - of[1].offset};
    case Operation::multiply:
      if (of[0].slope != 0.0) std::swap(of[0], of[1]);
      if (of[0].slope != 0.0) return std::nullopt;
      return Line{of[0].offset * of[1].slope, of[0].offset * of[1].offset};
    case Operation::divide:
      if (of[1].slope != 0.0) return std::nullopt;
      return Line{of[0].slope / of[1].offset, of[0].offset / of[1].offset};
    default:
      return std::nullopt;
  }
}

std::optional<double> Quotients::factor_of_line(NodeId id) {
  if (!graph_->is_number(border_.rhs)) return std::nullopt;
  const std::optional<Line> line = line_of(id);
  if (!line || line->slope == 0.0) return std::nullopt;
  const double at_rhs = line->slope * (*graph_)[border_.rhs].number;
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  if (!(std::fabs(at_rhs + line->offset) <= kRounding * std::fabs(at_rhs))) return std::nullopt;
  return line->slope;
}

std::optional<NodeId> Quotients::of(NodeId id) {
  const auto known = known_.find(id);
  if (known != known_.end()) return known->second;
  const std::optional<NodeId> found = look(id);
  known_.emplace(id, found);
  return found;
}

std::optional<NodeId> Quotients::look(NodeId id) {
  if (id == one_way_) return graph_->number(1.0);
  if (id == other_way_) return graph_->number(-1.0);
  if (graph_->is_number(id, 0.0)) return id;
  if (const std::optional<double> factor = factor_of_line(id)) return graph_->number(*factor);
  const Node node = (*graph_)[id];
  switch (node.operation) {
    case Operation::negate:
      if (const auto quotient = of(node.arguments[0])) {
        return graph_->make(Operation::negate, {*quotient});
      }
      break;
    case Operation::divide:
      if (const auto quotient = of(node.arguments[0])) {
        return make(Operation::divide, *quotient, node.arguments[1]);
      }
      break;
    case Operation::multiply:
      for (const std::size_t i : {0U, 1U}) {
        if (const auto quotient = of(node.arguments[i])) {
          return make(Operation::multiply, *quotient, node.arguments[1 - i]);
        }
      }
      break;
    case Operation::add:
    case Operation::subtract: {
      const auto left = of(node.arguments[0]), right = of(node.arguments[1]);
      if (left && right) return make(node.operation, *left, *right);
      break;
    }
    default:
      break;
  }
  if (!states_.contains(border_.lhs)) return std::nullopt;
  return by_slope(id);
}

std::optional<NodeId> Quotients::by_slope(NodeId id) {
  if (!changed_by(*graph_, {border_.rhs}, {border_.lhs}).empty()) return std::nullopt;
  if (!graph_->is_number(at_border_(id), 0.0)) return std::nullopt;
  return at_border_(derivative(graph_, id, border_.lhs));
}

}  // namespace gearsweep
