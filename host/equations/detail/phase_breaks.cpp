#include "equations/detail/phase_breaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

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
                         NodeId phase, const std::vector<NodeId>& roots, const NodeNames& names) {
  std::vector<bool> is_changing(graph.size());
  is_changing[phase] = true;
  const std::vector<NodeId> parts = parts_of(graph, roots);
  std::vector<NodeId> constants, nodes;
  std::unordered_map<NodeId, std::size_t> places = {{phase, 0}};
  const auto changes = [&](NodeId id) { return is_changing[id]; };
  for (const NodeId id : parts) {
    if (id == phase || std::ranges::none_of(graph[id].arguments, changes)) continue;
    is_changing[id] = true;
    nodes.push_back(id);
    for (const NodeId argument : graph[id].arguments) {
      if (changes(argument) || places.contains(argument)) continue;
      places[argument] = 1 + constants.size();
      constants.push_back(argument);
    }
  }
  constants_ = Tape(graph, inputs, constants);
  constant_count_ = constants.size();
  for (const NodeId id : nodes) {
    const Node& node = graph[id];
    const std::size_t place = first_step() + steps_.size();
    places[id] = place;
    Step step{node.operation, 0, 0, 0, node.table, is_condition(node.operation)};
    const std::array<std::size_t*, 3> arguments = {&step.a, &step.b, &step.c};
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
      *arguments[i] = places.at(node.arguments[i]);
    }
    Breaker breaker{steps_.size(), {}, {}, ""};
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
        // What goes on from turn to turn has few of them in each.
        const std::vector<NodeId> read = parts_of(graph, {node.arguments[0]});
        const bool goes_on = !inputs.empty() && std::ranges::binary_search(read, inputs.back());
        if (corners.size() > kMaxTableCorners && !goes_on) {
          tables_left_out_.push_back(fmt::format(
              "{} has {} corners, more than {}: steps do not end at them and are of second order "
              "there; read it as 'cubic' if it is smooth",
              breaker.text, corners.size(), kMaxTableCorners));
        } else if (!corners.empty()) {
          add_table(corners);
        }
        break;
      }
      default:
        break;
    }
    steps_.push_back(std::move(step));
    std::erase_if(breaker.functions, [this](const Function& function) {
      return function.a < first_step() && function.a > 0 &&
             (function.sign == 0.0 || (function.b < first_step() && function.b > 0));
    });
    if (breaker.functions.empty()) continue;
    breaker.cone = steps_below(breaker.step);
    breaker.text = to_short_text(graph, id, names);
    breakers_.push_back(std::move(breaker));
  }
  for (const NodeId id : roots) {
    if (changes(id)) roots_.push_back(places.at(id));
  }
  order_breakers(roots_);
  find_deciding();
}

// Those of the steps that a breaker is made of, of breakers themselves and of what chooses.
void PhaseBreaks::find_deciding() {
  std::set<std::size_t> steps, found;
  for (const Breaker& breaker : breakers_) {
    steps.insert(breaker.cone.begin(), breaker.cone.end());
    steps.insert(breaker.step);
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const bool is_select = step.operation == Operation::select;
    const bool is_joint =
        step.operation == Operation::conjunction || step.operation == Operation::disjunction;
    std::vector<std::size_t> read;
    if (steps.contains(i)) {
      read = {step.a, step.b, step.c};
    } else if (is_joint) {
      read = {step.a, step.b};
    } else if (is_select) {
      read = {step.a};
    }
    for (const std::size_t place : read) {
      if (place > 0 && place < first_step()) found.insert(place - 1);
    }
  }
  deciding_.assign(found.begin(), found.end());
}

std::vector<std::vector<double>> PhaseBreaks::find_in_turns(std::vector<double> inputs,
                                                            std::size_t turns) const {
  std::vector<std::vector<double>> all;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    inputs.back() = static_cast<double>(turn);
    all.push_back(find(inputs));
  }
  return all;
}

std::vector<double> PhaseBreaks::find(const std::vector<double>& inputs) const {
  if (breakers_.empty()) return {};
  const std::vector<double> constants = constants_.run_all(inputs);
  std::vector<double> deciding;
  for (const std::size_t place : deciding_) deciding.push_back(constants[place]);
  return memory_->breaks(deciding, [&] { return search(inputs); });
}

// Rising, without itself.
std::vector<std::size_t> PhaseBreaks::steps_below(std::size_t step) const {
  std::vector<bool> is_below(step + 1);
  is_below[step] = true;
  std::vector<std::size_t> below;
  for (std::size_t i = step + 1; i-- > 0;) {
    if (!is_below[i]) continue;
    if (i != step) below.push_back(i);
    for (const std::size_t place : {steps_[i].a, steps_[i].b, steps_[i].c}) {
      if (place >= first_step()) is_below[place - first_step()] = true;
    }
  }
  std::ranges::reverse(below);
  return below;
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
