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

// Numbers of what a node compares: where value(a) + sign value(b) + offset is 0, it breaks.
struct Zero {
  double sign, offset;
};

std::vector<Zero> zeros_of(const ExpressionGraph& graph, const Node& node) {
  switch (node.operation) {
    case Operation::less:
    case Operation::less_or_equal:
    case Operation::equal:
    case Operation::min:
    case Operation::max:
    case Operation::stop:
      return {{-1.0, 0.0}};
    case Operation::backlash:
      return {{-1.0, 0.0}, {1.0, 0.0}};
    case Operation::sign:
    case Operation::absolute:
    case Operation::logarithm:
    case Operation::square_root:
    case Operation::arctangent_of_two:
    case Operation::divide:
      return {{0.0, 0.0}};
    case Operation::square_root_above_one:
      return {{0.0, 1.0}};
    case Operation::arcsine:
    case Operation::arccosine:
      return {{0.0, 1.0}, {0.0, -1.0}};
    case Operation::power:
      if (is_power_of_any(graph, node.arguments[1])) return {};
      return {{0.0, 0.0}};
    default:
      return {};
  }
}

}  // namespace

// Reads the graph. What the phase changes becomes steps, the rest that these read constants.
class PhaseBreaks::Reader {
 public:
  Reader(const ExpressionGraph& graph, const std::vector<NodeId>& inputs, const NodeNames& names,
         PhaseBreaks* out)
      : graph_(graph), inputs_(inputs), names_(names), out_(*out), is_changing_(graph.size()) {}

  void run(NodeId phase, const std::vector<NodeId>& roots) {
    for (const NodeId id : changing_nodes(phase, roots)) {
      add_step(id);
      add_breaker(id);
    }
    for (const NodeId id : roots) {
      if (is_changing_[id]) out_.roots_.push_back(places_.at(id));
    }
  }

 private:
  // Those that the phase changes, what they read before them. The others that they read are the
  // constants.
  std::vector<NodeId> changing_nodes(NodeId phase, const std::vector<NodeId>& roots) {
    std::vector<NodeId> constants, nodes;
    is_changing_[phase] = true;
    places_ = {{phase, 0}};
    const auto changes = [&](NodeId id) { return is_changing_[id]; };
    for (const NodeId id : parts_of(graph_, roots)) {
      if (id == phase || std::ranges::none_of(graph_[id].arguments, changes)) continue;
      is_changing_[id] = true;
      nodes.push_back(id);
      for (const NodeId argument : graph_[id].arguments) {
        if (changes(argument) || places_.contains(argument)) continue;
        places_[argument] = 1 + constants.size();
        constants.push_back(argument);
      }
    }
    out_.constants_ = Tape(graph_, inputs_, constants);
    out_.constant_count_ = constants.size();
    return nodes;
  }

  void add_step(NodeId id) {
    const Node& node = graph_[id];
    places_[id] = out_.first_step() + out_.steps_.size();
    Step step{node.operation, 0, 0, 0, node.table, is_condition(node.operation)};
    const std::array<std::size_t*, 3> arguments = {&step.a, &step.b, &step.c};
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
      *arguments[i] = places_.at(node.arguments[i]);
    }
    out_.steps_.push_back(std::move(step));
  }

  // The last step, if it may break.
  void add_breaker(NodeId id) {
    Breaker breaker{out_.steps_.size() - 1, functions_of(id), {}, ""};
    std::erase_if(breaker.functions, [this](const Function& function) {
      return is_constant(function.a) && (function.sign == 0.0 || is_constant(function.b));
    });
    if (breaker.functions.empty()) return;
    breaker.cone = out_.steps_below(breaker.step);
    breaker.text = to_short_text(graph_, id, names_);
    out_.breakers_.push_back(std::move(breaker));
  }

  bool is_constant(std::size_t place) const { return place > 0 && place < out_.first_step(); }

  // The node of the last step.
  std::vector<Function> functions_of(NodeId id) {
    const Node& node = graph_[id];
    if (node.operation == Operation::table) return functions_of_table(id);
    const Step& step = out_.steps_.back();
    if (node.operation == Operation::floor) return {{step.a, step.b, 0.0, 0.0, Levels::whole, {}}};
    if (node.operation == Operation::tangent) {
      return {{step.a, step.b, 0.0, 0.0, Levels::poles, {}}};
    }
    const std::size_t first = node.operation == Operation::divide ? step.b : step.a;
    std::vector<Function> functions;
    for (const Zero& zero : zeros_of(graph_, node)) {
      functions.push_back({first, step.b, zero.sign, zero.offset, Levels::zero, {}});
    }
    return functions;
  }

  std::vector<Function> functions_of_table(NodeId id) {
    const Node& node = graph_[id];
    std::vector<Function> functions;
    const auto add = [&](const std::vector<double>& phases) {
      const Step& step = out_.steps_.back();
      functions.push_back({step.a, step.b, 0.0, 0.0, Levels::table, in_turn(phases)});
    };
    if (!node.table->jumps().empty()) add(node.table->jumps());
    const std::vector<double> corners = node.table->corners();
    // What goes on from turn to turn has few of them in each.
    const std::vector<NodeId> read = parts_of(graph_, {node.arguments[0]});
    const bool goes_on = !inputs_.empty() && std::ranges::binary_search(read, inputs_.back());
    if (corners.size() > kMaxTableCorners && !goes_on) {
      out_.tables_left_out_.push_back(fmt::format(
          "{} has {} corners, more than {}: steps do not end at them and are of second order "
          "there; read it as 'cubic' if it is smooth",
          to_short_text(graph_, id, names_), corners.size(), kMaxTableCorners));
    } else if (!corners.empty()) {
      add(corners);
    }
    return functions;
  }

  const ExpressionGraph& graph_;
  const std::vector<NodeId>& inputs_;
  const NodeNames& names_;
  PhaseBreaks& out_;
  std::vector<bool> is_changing_;
  std::unordered_map<NodeId, std::size_t> places_;
};

PhaseBreaks::PhaseBreaks(const ExpressionGraph& graph, const std::vector<NodeId>& inputs,
                         NodeId phase, const std::vector<NodeId>& roots, const NodeNames& names) {
  Reader(graph, inputs, names, this).run(phase, roots);
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
