#include "equations/detail/borders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

// The nodes, among what `roots` are made of, that any of `sources` changes.
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
        if (is_taken_in_turns(id, 1.0)) return;
        const NodeId below = graph_->symbol(fmt::format("whole[{}]", id));
        const NodeId above = graph_->make(Operation::add, {below, number(1.0)});
        return add(id, argument(0), above, above, below);
      }
      case Operation::arctangent_of_two:  // jumps by a turn where its second argument is below 0
        if (is_taken_in_turns(id, 2.0 * std::numbers::pi)) return;
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

  // Whether a node is met only in sines, cosines and tangents, times what makes `jump` of it a
  // number of whole turns.
  bool is_taken_in_turns(NodeId id, double jump) {
    const std::set<NodeId> above = changed_by(*graph_, equations_, {id});
    const auto is_round = [&](NodeId parent) {
      const Node node = (*graph_)[parent];
      const bool turns = node.operation == Operation::sine || node.operation == Operation::cosine ||
                         node.operation == Operation::tangent;
      if (!turns || !above.contains(parent)) return false;
      const NodeId slope = derivative(graph_, node.arguments[0], id);
      if (!graph_->is_number(slope)) return false;
      const double count = (*graph_)[slope].number * jump / (2.0 * std::numbers::pi);
      return std::fabs(count - std::round(count)) < 1e-12 * (1.0 + std::fabs(count));
    };
    std::set<NodeId> open(equations_.begin(), equations_.end());
    while (!open.empty()) {
      const NodeId next = *open.rbegin();
      open.erase(next);
      if (next == id) return false;
      if (!above.contains(next) || is_round(next)) continue;
      for (const NodeId argument : (*graph_)[next].arguments) open.insert(argument);
    }
    return true;
  }

  ExpressionGraph* graph_;
  const std::vector<NodeId>& equations_;
  const std::set<NodeId> with_state_;
  std::map<std::pair<NodeId, NodeId>, Border> borders_;
  std::map<NodeId, NodeId> never_;  // conditions that hold for a moment only
};

// Tells whether two nodes are the same, but for the rounding of numbers.
class Sameness {
 public:
  explicit Sameness(const ExpressionGraph* graph) : graph_(graph) {}

  bool operator()(NodeId a, NodeId b) {
    if (a == b) return true;
    const auto [known, is_new] = known_.try_emplace({a, b}, false);
    if (!is_new) return known->second;
    const bool same = look((*graph_)[a], (*graph_)[b]);
    known_[{a, b}] = same;
    return same;
  }

 private:
  bool look(const Node& one, const Node& other) {
    if (one.operation != other.operation || one.table != other.table) return false;
    if (one.operation == Operation::number) {
      const double size = std::max(std::fabs(one.number), std::fabs(other.number));
      constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
      return std::fabs(one.number - other.number) <= kRounding * size;
    }
    return !one.arguments.empty() &&
           std::ranges::equal(one.arguments, other.arguments, std::ref(*this));
  }

  const ExpressionGraph* graph_;
  std::map<std::pair<NodeId, NodeId>, bool> known_;
};

// Whether the equations are the same on both sides of a border.
class Continuity {
 public:
  Continuity(Formula* formula, const std::vector<NodeId>& equations, const Border& border)
      : graph_(&formula->graph),
        equations_(equations),
        above_(graph_, border.above),
        below_(graph_, border.below),
        same_(graph_) {
    const std::set<NodeId> with_state =
        changed_by(*graph_, {border.lhs, border.rhs}, states_of(*formula));
    for (const auto& [from, to] :
         {std::pair(border.lhs, border.rhs), std::pair(border.rhs, border.lhs)}) {
      if (!with_state.contains(from)) continue;
      at_border_.emplace_back(graph_, border, from, to);
    }
    std::set<NodeId> sources;
    for (const auto& [node, side] : border.above) sources.insert(node);
    for (const NodeId id : changed_by(*graph_, equations, sources)) {
      if ((*graph_)[id].operation == Operation::divide) bent_quotients_.push_back(id);
    }
  }

  std::optional<std::size_t> first_jump() {
    for (std::size_t row = 0; row < equations_.size(); ++row) {
      const NodeId one = above_(equations_[row]), other = below_(equations_[row]);
      const bool is_continuous =
          one == other || std::ranges::any_of(at_border_, [&](AtBorder& at) {
            return same_(at.above(equations_[row]), at.below(equations_[row])) &&
                   !divides_by_zero(one, other, &at.plain);
          });
      if (!is_continuous) return row;
    }
    return std::nullopt;
  }

 private:
  // One side of the border put for the other, in equations as they are and as they are above and
  // below it. The sides are put in before anything is simplified: 0.3*abs(0.25*x) has no 0.25*x
  // once it is 0.075*x.
  struct AtBorder {
    AtBorder(ExpressionGraph* graph, const Border& border, NodeId from, NodeId to)
        : plain(graph, {{from, to}}),
          above(graph, sides(border.above, from, to)),
          below(graph, sides(border.below, from, to)) {}

    std::map<NodeId, NodeId> sides(const std::map<NodeId, NodeId>& branches, NodeId from,
                                   NodeId to) {
      std::map<NodeId, NodeId> out = {{from, to}};
      for (const auto& [node, branch] : branches) out.emplace(node, plain(branch));
      return out;
    }

    Rewriter plain, above, below;
  };

  // As x/abs(x), of which 0/0 tells nothing. What both sides have counts where it bends itself.
  bool divides_by_zero(NodeId one, NodeId other, Rewriter* at) {
    std::vector<NodeId> quotients;
    for (const NodeId id : bent_quotients_) {
      for (const NodeId side : {above_(id), below_(id)}) {
        const bool is_negated = (*graph_)[side].operation == Operation::negate;
        quotients.push_back(is_negated ? (*graph_)[side].arguments[0] : side);
      }
    }
    const std::vector<NodeId> ones = parts_of(*graph_, {one}), others = parts_of(*graph_, {other});
    std::ranges::set_symmetric_difference(ones, others, std::back_inserter(quotients));
    return std::ranges::any_of(quotients, [&](NodeId id) {
      const Node node = (*graph_)[id];
      return node.operation == Operation::divide &&
             graph_->is_number((*at)(node.arguments[1]), 0.0);
    });
  }

  ExpressionGraph* graph_;
  const std::vector<NodeId>& equations_;
  Rewriter above_, below_;
  std::vector<AtBorder> at_border_;
  std::vector<NodeId> bent_quotients_;
  Sameness same_;
};

// Quotients by lhs - rhs of what vanishes where that does.
class Quotients {
 public:
  Quotients(Formula* formula, const Border& border)
      : graph_(&formula->graph),
        states_(states_of(*formula)),
        border_(border),
        at_border_(graph_, {{border.lhs, border.rhs}}),
        one_way_(make(Operation::subtract, border.lhs, border.rhs)),
        other_way_(make(Operation::subtract, border.rhs, border.lhs)) {}

  // Of the difference of two nodes.
  std::optional<NodeId> of(NodeId a, NodeId b) {
    const auto known = known_pairs_.find({a, b});
    if (known != known_pairs_.end()) return known->second;
    const std::optional<NodeId> found = look(a, b);
    known_pairs_.emplace(std::pair(a, b), found);
    return found;
  }

 private:
  std::optional<NodeId> look(NodeId a, NodeId b) {
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

  // slope*lhs + offset.
  struct Line {
    double slope = 0.0, offset = 0.0;
  };

  // Of what numbers alone make of the left side.
  std::optional<Line> line_of(NodeId id) {
    const auto known = lines_.find(id);
    if (known != lines_.end()) return known->second;
    const std::optional<Line> found = look_for_line(id);
    lines_.emplace(id, found);
    return found;
  }

  std::optional<Line> look_for_line(NodeId id) {
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

  // c of what is c*(lhs - rhs) but for rounding, where rhs is a number.
  std::optional<double> factor_of_line(NodeId id) {
    if (!graph_->is_number(border_.rhs)) return std::nullopt;
    const std::optional<Line> line = line_of(id);
    if (!line || line->slope == 0.0) return std::nullopt;
    const double at_rhs = line->slope * (*graph_)[border_.rhs].number;
    constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
    if (!(std::fabs(at_rhs + line->offset) <= kRounding * std::fabs(at_rhs))) return std::nullopt;
    return line->slope;
  }

  NodeId make(Operation operation, NodeId a, NodeId b) { return graph_->make(operation, {a, b}); }

  std::optional<NodeId> of(NodeId id) {
    const auto known = known_.find(id);
    if (known != known_.end()) return known->second;
    const std::optional<NodeId> found = look(id);
    known_.emplace(id, found);
    return found;
  }

  std::optional<NodeId> look(NodeId id) {
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

  // To first order, by the derivative at the border; exact where that is the same everywhere.
  std::optional<NodeId> by_slope(NodeId id) {
    if (!changed_by(*graph_, {border_.rhs}, {border_.lhs}).empty()) return std::nullopt;
    if (!graph_->is_number(at_border_(id), 0.0)) return std::nullopt;
    return at_border_(derivative(graph_, id, border_.lhs));
  }

  ExpressionGraph* graph_;
  const std::set<NodeId> states_;
  const Border& border_;
  Rewriter at_border_;
  const NodeId one_way_, other_way_;
  std::map<NodeId, std::optional<NodeId>> known_;
  std::map<NodeId, std::optional<Line>> lines_;
  std::map<std::pair<NodeId, NodeId>, std::optional<NodeId>> known_pairs_;
};

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

std::vector<Border> find_borders(Formula* formula, const std::vector<NodeId>& equations) {
  return BorderFinder(formula, equations).run();
}

std::optional<std::size_t> first_jump(Formula* formula, const std::vector<NodeId>& equations,
                                      const Border& border) {
  return Continuity(formula, equations, border).first_jump();
}

std::optional<std::vector<NodeId>> steeper_above(Formula* formula,
                                                 const std::vector<NodeId>& equations,
                                                 const Border& border) {
  return Steepness(formula, equations, border).run();
}

}  // namespace gearsweep
