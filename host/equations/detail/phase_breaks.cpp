#include "equations/detail/phase_breaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "expression/print.hpp"

namespace gearsweep {
namespace {

bool is_power_of_any(const ExpressionGraph& graph, NodeId exponent) {
  if (!graph.is_number(exponent)) return false;
  const double value = graph[exponent].number;
  return value >= 0.0 && value == std::floor(value);
}

std::vector<double> in_turn(std::vector<double> phases) {
  for (double& phase : phases) phase -= kWholePhase * std::floor(phase / kWholePhase);
  std::ranges::sort(phases);
  return phases;
}

}  // namespace

PhaseBreaks::PhaseBreaks(const ExpressionGraph& graph, const std::vector<NodeId>& inputs,
                         NodeId phase, const std::vector<NodeId>& roots) {
  std::set<NodeId> changing = {phase};
  const std::vector<NodeId> parts = parts_of(graph, roots);
  std::vector<NodeId> constants, nodes;
  std::map<NodeId, std::size_t> places = {{phase, 0}};
  const auto changes = [&](NodeId id) { return changing.contains(id); };
  for (const NodeId id : parts) {
    if (id == phase || std::ranges::none_of(graph[id].arguments, changes)) continue;
    changing.insert(id);
    nodes.push_back(id);
    for (const NodeId argument : graph[id].arguments) {
      if (changes(argument) || places.contains(argument)) continue;
      places[argument] = 1 + constants.size();
      constants.push_back(argument);
    }
  }
  constants_ = Tape(graph, inputs, constants);
  constant_count_ = constants.size();
  std::vector<std::set<std::size_t>> cones;
  for (const NodeId id : nodes) {
    const Node& node = graph[id];
    const std::size_t place = first_step() + steps_.size();
    places[id] = place;
    Step step{node.operation, 0, 0, 0, node.table, is_condition(node.operation)};
    const std::array<std::size_t*, 3> arguments = {&step.a, &step.b, &step.c};
    std::set<std::size_t> cone = {steps_.size()};
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
      *arguments[i] = places.at(node.arguments[i]);
      if (*arguments[i] < first_step()) continue;
      const std::set<std::size_t>& below = cones[*arguments[i] - first_step()];
      cone.insert(below.begin(), below.end());
    }
    cones.push_back(cone);
    Breaker breaker{steps_.size(), {}, {cone.begin(), cone.end()}, to_short_text(graph, id)};
    breaker.cone.pop_back();  // itself
    const auto add = [&](Levels levels, double sign, double offset) {
      breaker.functions.push_back({step.a, step.b, sign, offset, levels, {}});
    };
    const auto add_table = [&](const std::vector<double>& phases) {
      add(Levels::table, 0.0, 0.0);
      breaker.functions.back().phases = in_turn(phases);
    };
    switch (node.operation) {
      case Operation::less:
      case Operation::less_or_equal:
      case Operation::equal:
      case Operation::min:
      case Operation::max:
      case Operation::stop:
        add(Levels::zero, -1.0, 0.0);
        break;
      case Operation::backlash:
        add(Levels::zero, -1.0, 0.0);
        add(Levels::zero, 1.0, 0.0);
        break;
      case Operation::sign:
      case Operation::absolute:
      case Operation::logarithm:
      case Operation::square_root:
      case Operation::arctangent_of_two:
        add(Levels::zero, 0.0, 0.0);
        break;
      case Operation::square_root_above_one:
        add(Levels::zero, 0.0, 1.0);
        break;
      case Operation::arcsine:
      case Operation::arccosine:
        add(Levels::zero, 0.0, 1.0);
        add(Levels::zero, 0.0, -1.0);
        break;
      case Operation::power:
        if (!is_power_of_any(graph, node.arguments[1])) add(Levels::zero, 0.0, 0.0);
        break;
      case Operation::floor:
        add(Levels::whole, 0.0, 0.0);
        break;
      case Operation::tangent:
        add(Levels::poles, 0.0, 0.0);
        break;
      case Operation::divide:
        add(Levels::zero, 0.0, 0.0);
        breaker.functions.back().a = step.b;
        break;
      case Operation::table: {
        if (!node.table->jumps().empty()) add_table(node.table->jumps());
        const std::vector<double> corners = node.table->corners();
        if (corners.size() > kMaxTableCorners) {
          tables_left_out_.push_back(fmt::format(
              "{} has {} corners, more than {}: steps do not end at them and are of second order "
              "there; read it as 'cubic' if it is smooth",
              breaker.text, corners.size(), kMaxTableCorners));
        } else if (!corners.empty()) {
          add_table(corners);
        }
        break;
      }
      case Operation::select:
        has_choices_ = true;
        break;
      default:
        break;
    }
    steps_.push_back(std::move(step));
    std::erase_if(breaker.functions, [this](const Function& function) {
      return function.a < first_step() && function.a > 0 &&
             (function.sign == 0.0 || (function.b < first_step() && function.b > 0));
    });
    if (!breaker.functions.empty()) breakers_.push_back(std::move(breaker));
  }
  for (const NodeId id : roots) {
    if (changes(id)) roots_.push_back(places.at(id));
  }
  order_breakers(roots_);
}

// Depth first, a condition before what it chooses from.
void PhaseBreaks::order_breakers(const std::vector<std::size_t>& roots) {
  ranks_.assign(steps_.size(), steps_.size());
  std::size_t rank = 0;
  std::vector<std::pair<std::size_t, bool>> open;  // steps, and whether all below them is known
  const auto push = [&](std::size_t place) {
    if (place >= first_step()) open.emplace_back(place - first_step(), false);
  };
  for (const std::size_t root : roots) {
    push(root);
    while (!open.empty()) {
      const auto [step, is_below_known] = open.back();
      open.pop_back();
      if (ranks_[step] < steps_.size()) continue;
      if (is_below_known) {
        ranks_[step] = rank++;
        continue;
      }
      open.emplace_back(step, true);
      // The last one is the first to be looked at.
      for (const std::size_t place : {steps_[step].c, steps_[step].b, steps_[step].a}) push(place);
    }
  }
  std::ranges::sort(breakers_, {}, [this](const Breaker& breaker) { return ranks_[breaker.step]; });
}

std::vector<std::string> PhaseBreaks::texts() const {
  std::vector<std::string> texts;
  for (const Breaker& breaker : breakers_) {
    if (std::ranges::find(texts, breaker.text) == texts.end()) texts.push_back(breaker.text);
  }
  return texts;
}

}  // namespace gearsweep
