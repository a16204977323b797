#include "equations/detail/border_jump.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace gearsweep {
namespace {

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

}  // namespace

std::optional<std::size_t> first_jump(Formula* formula, const std::vector<NodeId>& equations,
                                      const Border& border) {
  return Continuity(formula, equations, border).first_jump();
}

}  // namespace gearsweep
