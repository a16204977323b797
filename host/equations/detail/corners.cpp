#include "equations/detail/corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "equations/detail/border_jump.hpp"
#include "equations/detail/border_slopes.hpp"
#include "equations/detail/borders.hpp"
#include "equations/detail/contacts.hpp"
#include "expression/print.hpp"

namespace gearsweep {
namespace {

bool chooses(Operation operation) {
  return is_condition(operation) || operation == Operation::absolute ||
         operation == Operation::sign || operation == Operation::min ||
         operation == Operation::max || operation == Operation::floor ||
         operation == Operation::square_root || operation == Operation::arctangent_of_two;
}

// Whether it jumps itself. x/abs(x) does, too, but is no number at the jump.
bool has_sides(Operation operation) {
  return is_condition(operation) || operation == Operation::sign || operation == Operation::floor;
}

std::string text_of(const ExpressionGraph& graph, NodeId id) {
  const bool is_plain = !is_condition(graph[id].operation);
  return (is_plain ? "" : "the condition ") + to_short_text(graph, id);
}

class CornerFinder {
 public:
  CornerFinder(Formula* formula, const std::vector<NodeId>& equations)
      : formula_(formula), worked_on_(*formula), equations_(equations) {}

  Corners run() {
    for (const Border& border : find_borders(&worked_on_, equations_)) look_at(border);
    take_jumps();
    return std::move(corners_);
  }

 private:
  void look_at(const Border& border) {
    const auto changes = [&](const auto& side) {
      return border.below.at(side.first) != side.second;
    };
    const NodeId node = std::ranges::find_if(border.above, changes)->first;
    RoughPlace place{text_of(worked_on_.graph, node), equation_of(border)};
    if (const auto row = first_jump(&worked_on_, equations_, border)) {
      place.equation = *row;
      jumps_.emplace_back(std::move(place), border);
      return;
    }
    const auto steeper = steeper_above(&worked_on_, equations_, border);
    const bool is_known = steeper && stay_finite(worked_on_.graph, *steeper) &&
                          std::ranges::any_of(*steeper, [&](NodeId id) {
                            return !worked_on_.graph.is_number(id, 0.0);
                          });
    if (!is_known || corners_.list.size() == kMaxCorners) {
      corners_.uncorrected.push_back(std::move(place));
      return;
    }
    Corner corner{place.expression, taken_over(border.lhs), taken_over(border.rhs), {}};
    for (const NodeId id : *steeper) corner.direction.push_back(taken_over(id));
    corners_.list.push_back(std::move(corner));
  }

  // Jumps become what steps are cut at, but for those of atan2, which stays on no side of them, and
  // those whose place jumps itself.
  void take_jumps() {
    std::set<NodeId> jumping;
    for (const auto& [place, border] : jumps_) {
      for (const auto& [node, side] : border.above) {
        if (border.below.at(node) != side) jumping.insert(node);
      }
    }
    for (const auto& [place, border] : jumps_) {
      const std::vector<NodeId> parts = parts_of(worked_on_.graph, {border.lhs, border.rhs});
      const bool is_within =
          std::ranges::any_of(parts, [&](NodeId part) { return jumping.contains(part); });
      Jump jump{place, 0, 0, false, {}, {}};
      // How a table changes with the phase is not known.
      const bool is_read = std::ranges::any_of(
          parts, [&](NodeId part) { return worked_on_.graph[part].operation == Operation::table; });
      bool is_known = !is_within && !is_read && corners_.jumps.size() < kMaxJumps;
      bool has_side = false;
      for (const auto& [node, side] : border.above) {
        const Operation operation = worked_on_.graph[node].operation;
        is_known &= operation != Operation::arctangent_of_two;
        jump.is_staircase |= operation == Operation::floor;
        has_side |= border.below.at(node) != side && has_sides(operation);
      }
      is_known &= has_side;
      if (!is_known) {
        corners_.unlocated.push_back(place);
        continue;
      }
      for (const auto& [node, side] : border.above) {
        const NodeId below = border.below.at(node);
        const bool is_step = worked_on_.graph[node].operation == Operation::floor;
        jump.above[taken_over(node)] = taken_over(is_step ? node : side);
        jump.below[taken_over(node)] = taken_over(is_step ? node : below);
      }
      jump.lhs = taken_over(border.lhs);
      jump.rhs = jump.is_staircase ? formula_->graph.number(0.0) : taken_over(border.rhs);
      corners_.jumps.push_back(std::move(jump));
    }
  }

  std::size_t equation_of(const Border& border) const {
    const auto has = [&](NodeId row) {
      return std::ranges::any_of(parts_of(worked_on_.graph, {row}), [&](NodeId part) {
        const auto above = border.above.find(part);
        // An `==` is the same on both sides of every border.
        return above != border.above.end() && above->second != border.below.at(part);
      });
    };
    return static_cast<std::size_t>(std::ranges::find_if(equations_, has) - equations_.begin());
  }

  // The same node of the formula's own graph.
  NodeId taken_over(NodeId id) {
    for (const NodeId part : parts_of(worked_on_.graph, {id})) {
      const Node& node = worked_on_.graph[part];
      std::vector<NodeId> arguments;
      for (const NodeId argument : node.arguments) arguments.push_back(taken_over_.at(argument));
      taken_over_[part] = node.operation == Operation::number ? formula_->graph.number(node.number)
                          : node.operation == Operation::symbol
                              ? formula_->graph.symbol(node.symbol)
                          : node.operation == Operation::table
                              ? formula_->graph.table(node.table, arguments[0], arguments[1])
                              : formula_->graph.as_written(node.operation, arguments);
    }
    return taken_over_.at(id);
  }

  Formula* formula_;
  Formula worked_on_;  // grows by what is tried
  const std::vector<NodeId>& equations_;
  std::map<NodeId, NodeId> taken_over_;
  std::vector<std::pair<RoughPlace, Border>> jumps_;
  Corners corners_;
};

}  // namespace

bool may_jump(const Formula& formula, const std::vector<NodeId>& equations) {
  const std::set<NodeId> with_state = changed_by(formula.graph, equations, states_of(formula));
  return std::ranges::any_of(with_state,
                             [&](NodeId id) { return has_sides(formula.graph[id].operation); });
}

Corners find_corners(Formula* formula, const std::vector<NodeId>& equations) {
  const ExpressionGraph& graph = formula->graph;
  const bool has_any = std::ranges::any_of(parts_of(graph, equations),
                                           [&](NodeId id) { return chooses(graph[id].operation); });
  return has_any ? CornerFinder(formula, equations).run() : Corners();
}

}  // namespace gearsweep
