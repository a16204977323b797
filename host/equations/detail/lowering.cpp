#include "equations/detail/lowering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "equations/detail/borders.hpp"
#include "equations/detail/inner_loop.hpp"
#include "equations/detail/mean_of_sides.hpp"
#include "equations/detail/phase_breaks.hpp"
#include "expression/differentiate.hpp"
#include "expression/magnitude.hpp"

namespace gearsweep {
namespace {

class Lowering {
 public:
  explicit Lowering(Formula* formula)
      : formula_(formula), graph_(&formula->graph), loop_(formula, &lowered_) {
    lowered_.shapes_phase.assign(formula->parameters.size(), false);
  }

  Lowered run() {
    Rewriter simplify(graph_, {});
    std::vector<NodeId> equations, signals;
    for (const NodeId id : formula_->equations) equations.push_back(simplify(id));
    for (const NodeId id : formula_->signals) signals.push_back(simplify(id));
    formula_->period = simplify(formula_->period);
    for (auto& [name, value] : formula_->constants) {
      value = simplify(value);
      if (!(*graph_)[value].arguments.empty()) formula_->names.emplace(value, name);
    }
    const std::vector<NodeId> free = equations;
    if (!formula_->impacts.empty() || may_jump(*formula_, equations)) {
      hold_sides(&equations, &signals);
    }
    add_sections(equations, &signals);
    lowered_.is_second_order = is_second_order(equations);
    if (lowered_.is_second_order) loop_.know_velocities();
    const auto changes = [this](NodeId id) { return loop_.dependence_of(id).phase; };
    loop_.know_phase(std::ranges::any_of(equations, changes) ||
                     std::ranges::any_of(signals, changes));
    // The signals are another function: that they have a part, too, is no reason to keep it whole.
    loop_.count_uses(equations);
    for (const NodeId id : equations) lowered_.equations.push_back(inner(id));
    loop_.count_uses(signals);
    for (const NodeId id : signals) lowered_.signals.push_back(inner(id));
    for (const NodeId row : lowered_.equations) {
      for (const NodeId state : formula_->states) {
        lowered_.jacobian.push_back(derivative(graph_, row, state));
      }
    }
    lower_surfaces(equations);
    if (!lowered_.surfaces.empty()) find_phase_slopes();
    find_contacts_of(free, equations);
    return std::move(lowered_);
  }

 private:
  bool is_second_order(const std::vector<NodeId>& equations) const {
    const std::size_t half = equations.size() / 2;
    return equations.size() % 2 == 0 &&
           std::equal(equations.begin(), equations.begin() + static_cast<std::ptrdiff_t>(half),
                      formula_->states.begin() + static_cast<std::ptrdiff_t>(half));
  }

  // Finds the jumps, and puts the side that a motion is on into what jumps there.
  void hold_sides(std::vector<NodeId>* equations, std::vector<NodeId>* signals) {
    corners_ = find_corners(formula_, *equations);
    std::vector<NodeId> sides;
    for (const Jump& jump : corners_->jumps) {
      const NodeId side = graph_->symbol(fmt::format("side[{}]", sides.size()));
      sides.push_back(side);
      for (const auto& [node, above] : jump.above) {
        held_[node] = on_side(side, jump, node, above, jump.below.at(node));
      }
    }
    hold_in_signals(sides, *signals);
    for (Formula::Impact& impact : formula_->impacts) {
      sides.push_back(graph_->symbol(fmt::format("side[{}]", sides.size())));
      Rewriter simplify(graph_, {});
      impact.when = simplify(impact.when);
      for (NodeId& id : impact.reset) id = simplify(id);
    }
    loop_.know_sides(sides);
    Rewriter hold(graph_, held_);
    for (NodeId& id : *equations) id = hold(id);
    for (NodeId& id : *signals) id = mean_of_sides(graph_, hold(id), {sides.begin(), sides.end()});
  }

  // What signals have where the equations jump is on the same side, however it is written.
  void hold_in_signals(const std::vector<NodeId>& sides, const std::vector<NodeId>& signals) {
    if (corners_->jumps.empty()) return;
    for (const Border& border : find_borders(formula_, signals)) {
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const Jump& jump = corners_->jumps[i];
        if (jump.is_staircase || jump.lhs != border.lhs || jump.rhs != border.rhs) continue;
        for (const auto& [node, above] : border.above) {
          if ((*graph_)[node].operation == Operation::arctangent_of_two) continue;
          held_.try_emplace(node, on_side(sides[i], jump, node, above, border.below.at(node)));
        }
      }
    }
  }

  // Level, rate and size of each section are signals. equations: held on their sides.
  void add_sections(const std::vector<NodeId>& equations, std::vector<NodeId>* signals) {
    Rewriter hold(graph_, held_), simplify(graph_, {});
    for (const Formula::Section& section : formula_->sections) {
      NodeId level = hold(simplify(section.value));
      if (section.of_rate) level = rate_of(level, equations);
      if (section.is_down) level = graph_->make(Operation::negate, {level});
      signals->push_back(level);
      signals->push_back(rate_of(level, equations));
      signals->push_back(magnitude_of(graph_, level));
    }
  }

  // What a node is on a side of a jump: of one that is a number on both sides without a choice.
  NodeId on_side(NodeId side, const Jump& jump, NodeId node, NodeId above, NodeId below) {
    if (jump.is_staircase) return side;
    const Operation operation = (*graph_)[node].operation;
    const NodeId half = graph_->number(0.5);
    if (is_condition(operation)) {
      if (above == below) return above;
      return graph_->is_number(above, 0.0) ? make(Operation::less, side, half)
                                           : make(Operation::less, half, side);
    }
    if (operation == Operation::sign) {
      const NodeId turned = graph_->number((*graph_)[above].number - (*graph_)[below].number);
      return make(Operation::add, make(Operation::multiply, turned, side), below);
    }
    return graph_->make(Operation::select, {make(Operation::less, half, side), above, below});
  }

  // equations: held on their sides.
  void lower_surfaces(const std::vector<NodeId>& equations) {
    if (!corners_) return;
    Rewriter hold(graph_, held_);
    const auto add = [&](NodeId level) -> Surface& {
      Surface surface;
      surface.side = graph_->symbol(fmt::format("side[{}]", lowered_.surfaces.size()));
      surface.level = surface.held = inner(level);
      surface.drift = surface.held_drift = inner(drift_of(level));
      lowered_.surfaces.push_back(surface);
      return lowered_.surfaces.back();
    };
    for (const Jump& jump : corners_->jumps) {
      Surface& surface = add(make(Operation::subtract, hold(jump.lhs), hold(jump.rhs)));
      surface.place = jump.place;
      surface.is_staircase = jump.is_staircase;
    }
    for (std::size_t i = 0; i < formula_->impacts.size(); ++i) {
      const NodeId level = hold(formula_->impacts[i].when);
      Surface& surface = add(level);
      const NodeId rate = rate_of(level, equations);
      surface.name = formula_->impacts[i].name;
      surface.held = inner(rate);
      surface.held_drift = inner(drift_of(rate));
      for (std::size_t j = 0; j < equations.size(); ++j) {
        const NodeId reset = hold(formula_->impacts[i].reset[j]);
        const NodeId change = make(Operation::subtract, reset, formula_->states[j]);
        NodeId turn = graph_->number(0.0);
        for (const NodeId state : formula_->states) {
          const NodeId part = make(Operation::multiply, derivative(graph_, change, state),
                                   derivative(graph_, rate, state));
          turn = make(Operation::add, turn, part);
        }
        surface.reset.push_back(inner(reset));
        surface.reset_drift.push_back(inner(drift_of(reset)));
        surface.turn.push_back(inner(turn));
      }
    }
  }

  NodeId rate_of(NodeId id, const std::vector<NodeId>& equations) {
    NodeId rate = drift_of(id);
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const NodeId slope = derivative(graph_, id, formula_->states[i]);
      rate = make(Operation::add, rate, make(Operation::multiply, slope, equations[i]));
    }
    return rate;
  }

  // The phase that a period takes, whose turns make its cycle.
  NodeId phase_turn() {
    return make(Operation::multiply, graph_->number(kWholePhase), formula_->cycle);
  }

  // The rate of what changes with the phase.
  NodeId drift_of(NodeId id) {
    const NodeId slope = derivative(graph_, id, formula_->phase);
    return make(Operation::multiply, slope,
                make(Operation::divide, phase_turn(), formula_->period));
  }

  // The slopes of the coefficients that surfaces are made of. How a table changes with the phase is
  // not known.
  void find_phase_slopes() {
    std::vector<NodeId> roots;
    for (const Surface& surface : lowered_.surfaces) {
      roots.insert(roots.end(), {surface.level, surface.drift, surface.held, surface.held_drift});
      roots.insert(roots.end(), surface.reset.begin(), surface.reset.end());
    }
    lowered_.phase_turn = inner(phase_turn());
    const std::vector<NodeId> parts = parts_of(*graph_, roots);
    const std::size_t count = lowered_.coefs.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (std::ranges::find(parts, lowered_.coefs[i]) == parts.end()) continue;
      const NodeId value = lowered_.coef_values[i];
      const NodeId slope = derivative(graph_, value, formula_->phase);
      const std::vector<NodeId> of_value = parts_of(*graph_, {value});
      const bool is_read = std::ranges::any_of(
          of_value, [&](NodeId part) { return (*graph_)[part].operation == Operation::table; });
      if (is_read || graph_->is_number(slope, 0.0)) continue;
      loop_.coef(slope);
      const auto place = std::ranges::find(lowered_.coef_values, slope);
      lowered_.phase_slopes.emplace_back(
          i, static_cast<std::size_t>(place - lowered_.coef_values.begin()));
    }
  }

  NodeId make(Operation operation, NodeId a, NodeId b) { return graph_->make(operation, {a, b}); }

  NodeId inner(NodeId id) { return loop_.arranged(id); }

  // False for what is known to be a parameter that is never negative.
  bool may_be_negative(NodeId id) const {
    const auto field = std::ranges::find(lowered_.point, id);
    if (field == lowered_.point.end()) return true;
    const NodeId value =
        lowered_.point_values[static_cast<std::size_t>(field - lowered_.point.begin())];
    const auto parameter = std::ranges::find(formula_->parameters, value);
    return parameter == formula_->parameters.end() ||
           formula_
               ->are_negative[static_cast<std::size_t>(parameter - formula_->parameters.begin())];
  }

  // The contacts of equations before they were lowered, as the names of constants are of these: as
  // they are written, and as they are on the sides of their jumps.
  void find_contacts_of(const std::vector<NodeId>& written, const std::vector<NodeId>& equations) {
    std::map<NodeId, std::string> names;
    for (const NodeId id : parts_of(*graph_, equations)) {
      if (const auto lowered = loop_.known(id)) names[*lowered] = innermost_constant(id);
    }
    if (!corners_) corners_ = find_corners(formula_, written);
    std::vector<Contact> hidden;
    for (const Corner& corner : corners_->list) hidden.push_back(lowered(corner));
    lowered_.uncorrected = std::move(corners_->uncorrected);
    lowered_.jumps = std::move(corners_->unlocated);
    lowered_.contacts = find_contacts(formula_, lowered_.equations, names, hidden);
    for (Contact& contact : lowered_.contacts.list) {
      contact.may_be_negative = may_be_negative(contact.backlash);
    }
  }

  Contact lowered(const Corner& corner) {
    Contact contact;
    Rewriter hold(graph_, held_);
    contact.name = corner.expression;
    contact.deflection = inner(hold(corner.lhs));
    contact.backlash = inner(hold(corner.rhs));
    contact.is_one_sided = true;
    contact.is_hidden = true;
    for (const NodeId id : corner.direction) contact.direction.push_back(inner(hold(id)));
    return contact;
  }

  // The smallest constant that holds a node; empty where there is none.
  std::string innermost_constant(NodeId id) {
    const Operation operation = (*graph_)[id].operation;
    if (operation != Operation::backlash && operation != Operation::stop) return "";
    std::string name;
    std::size_t least = graph_->size() + 1;
    for (const auto& [constant, value] : formula_->constants) {
      const std::vector<NodeId> parts = parts_of(*graph_, {value});
      if (std::ranges::find(parts, id) == parts.end() || parts.size() >= least) continue;
      least = parts.size();
      name = constant;
    }
    return name;
  }

  Formula* formula_;
  ExpressionGraph* graph_;
  Lowered lowered_;
  InnerLoop loop_;
  std::optional<Corners> corners_;
  std::map<NodeId, NodeId> held_;  // what jumps, and what it is on the side that is held
};

}  // namespace

Lowered lower(Formula* formula) { return Lowering(formula).run(); }

}  // namespace gearsweep
