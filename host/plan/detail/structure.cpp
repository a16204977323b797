#include "plan/detail/structure.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "plan/detail/linear_forms.hpp"

namespace gearsweep {
namespace {

// Operations that are finite wherever their arguments are.
constexpr std::array kFiniteOperations = {Operation::number,
                                          Operation::symbol,
                                          Operation::negate,
                                          Operation::add,
                                          Operation::subtract,
                                          Operation::multiply,
                                          Operation::sine,
                                          Operation::cosine,
                                          Operation::arctangent,
                                          Operation::arctangent_of_two,
                                          Operation::hyperbolic_tangent,
                                          Operation::absolute,
                                          Operation::sign,
                                          Operation::floor,
                                          Operation::min,
                                          Operation::max,
                                          Operation::backlash,
                                          Operation::stop,
                                          Operation::select,
                                          Operation::table};

bool is_always_finite(Operation operation) {
  return is_condition(operation) ||
         std::ranges::find(kFiniteOperations, operation) != kFiniteOperations.end();
}

// The value that all points share; nothing where they differ.
std::optional<double> common_value(const Study& study, std::size_t parameter) {
  const Swept* const swept = study.find_swept(false, parameter);
  if (swept == nullptr) return study.setting.parameters[parameter];
  const auto is_first = [&](double value) { return value == swept->values.front(); };
  if (!std::ranges::all_of(swept->values, is_first)) return std::nullopt;
  for (const UncertainParameter& uncertain : study.uncertain.parameters) {
    const auto is_it = [&](const Swept& one) { return one.index == parameter; };
    if (std::ranges::any_of(uncertain.draws.swept(), is_it)) return std::nullopt;
  }
  return swept->values.front();
}

bool is_in(const std::vector<NodeId>& symbols, NodeId id) {
  return std::ranges::find(symbols, id) != symbols.end();
}

void rewrite(Rewriter* rewriter, std::vector<NodeId>* nodes) {
  for (NodeId& node : *nodes) node = (*rewriter)(node);
}

}  // namespace

Structure::Structure(const Study& study) : field_(field_of(*study.model, study.setting.options)) {
  ExpressionGraph* const graph = &field_.graph;
  Rewriter simplified(graph, {});
  rewrite(&simplified, &field_.rates);
  rewrite(&simplified, &field_.signals);
  symbolic_rates_ = field_.rates;
  symbolic_signals_ = field_.signals;
  std::map<NodeId, NodeId> numbers;
  for (std::size_t i = 0; i < field_.parameters.size(); ++i) {
    const std::optional<double> value = common_value(study, i);
    if (value) numbers[field_.parameters[i]] = graph->number(*value);
  }
  Rewriter with_numbers(graph, std::move(numbers));
  rewrite(&with_numbers, &field_.rates);
  rewrite(&with_numbers, &field_.signals);
  for (const NodeId rate : field_.rates) drivers_.push_back(states_in(rate));
}

bool Structure::is_autonomous() const {
  return std::ranges::all_of(parts_of(field_.graph, field_.rates), [&](NodeId id) {
    const Operation operation = field_.graph[id].operation;
    if (operation == Operation::table) return false;
    return operation != Operation::symbol || is_in(field_.states, id) ||
           is_in(field_.parameters, id);
  });
}

std::set<std::size_t> Structure::states_in(NodeId id) const {
  const std::vector<std::size_t> states = symbols_in(field_.graph, {id}, field_.states);
  return {states.begin(), states.end()};
}

std::set<std::size_t> Structure::drivers_of_signal(std::size_t signal) const {
  return states_in(field_.signals[signal]);
}

std::set<std::size_t> Structure::closure(std::set<std::size_t> states) const {
  std::vector<std::size_t> open(states.begin(), states.end());
  while (!open.empty()) {
    const std::size_t state = open.back();
    open.pop_back();
    for (const std::size_t driver : drivers_[state]) {
      if (states.insert(driver).second) open.push_back(driver);
    }
  }
  return states;
}

bool Structure::is_finite_whatever(const std::vector<std::size_t>& states,
                                   const std::set<std::size_t>& signals) const {
  const ExpressionGraph& graph = field_.graph;
  std::set<NodeId> depending;
  for (const std::size_t state : states) depending.insert(field_.states[state]);
  std::vector<NodeId> others;
  for (std::size_t i = 0; i < symbolic_rates_.size(); ++i) {
    if (std::ranges::find(states, i) == states.end()) others.push_back(symbolic_rates_[i]);
  }
  for (const std::size_t signal : signals) others.push_back(symbolic_signals_[signal]);
  for (const NodeId id : parts_of(graph, others)) {
    const Node& node = graph[id];
    const auto depends = [&](NodeId argument) { return depending.contains(argument); };
    if (std::ranges::none_of(node.arguments, depends)) continue;
    depending.insert(id);
    const bool divides = node.operation == Operation::divide && !depends(node.arguments[1]);
    if (!divides && !is_always_finite(node.operation)) return false;
  }
  return true;
}

bool Structure::keeps_mirrored(const std::vector<MirrorPairs::Pair>& mirrors) {
  ExpressionGraph* const graph = &field_.graph;
  std::map<NodeId, NodeId> mirrored;
  for (const auto [first, second] : mirrors) {
    mirrored[field_.states[second]] = graph->make(Operation::negate, {field_.states[first]});
  }
  Rewriter mirror(graph, std::move(mirrored));
  return std::ranges::all_of(mirrors, [&](const MirrorPairs::Pair& pair) {
    const NodeId sum = graph->make(
        Operation::add, {mirror(field_.rates[pair.first]), mirror(field_.rates[pair.second])});
    return is_zero_sum(*graph, sum);
  });
}

std::optional<LinearBlock> Structure::left_out(const Reduction& reduction) {
  ExpressionGraph* const graph = &field_.graph;
  // x[first] = m + s/2 and x[second] = s/2 - m, where s is their sum.
  std::map<NodeId, NodeId> apart;
  std::vector<NodeId> symbols, rates, sums;
  for (const auto [first, second] : reduction.mirrors) {
    const NodeId mirrored = field_.states[first];
    sums.push_back(graph->symbol("sum->" + std::to_string(first)));
    const NodeId half = graph->make(Operation::multiply, {graph->number(0.5), sums.back()});
    apart[field_.states[first]] = graph->make(Operation::add, {mirrored, half});
    apart[field_.states[second]] = graph->make(Operation::subtract, {half, mirrored});
  }
  Rewriter with_sums(graph, std::move(apart));
  for (const std::size_t state : reduction.passive) {
    symbols.push_back(field_.states[state]);
    rates.push_back(field_.rates[state]);
  }
  const std::size_t passive = rates.size();
  for (const auto [first, second] : reduction.mirrors) {
    rates.push_back(graph->make(Operation::add,
                                {with_sums(field_.rates[first]), with_sums(field_.rates[second])}));
  }
  // The sums stay 0, and a passive state may be driven by what is 0: each of the two kinds by
  // itself.
  const auto first_sum = rates.begin() + static_cast<std::ptrdiff_t>(passive);
  const auto own_forms = linear_forms(graph, {rates.begin(), first_sum}, symbols);
  const auto sum_forms = linear_forms(graph, {first_sum, rates.end()}, sums);
  LinearBlock block;
  const std::size_t size = rates.size();
  block.entries.assign(size * size, graph->number(0.0));
  for (std::size_t i = 0; i < size; ++i) {
    const bool is_own = i < passive;
    const auto& form = is_own ? own_forms[i] : sum_forms[i - passive];
    if (!form) return std::nullopt;
    const std::vector<NodeId>& of = is_own ? symbols : sums;
    for (std::size_t j = 0; j < of.size(); ++j) {
      const auto found = form->find(of[j]);
      if (found != form->end())
        block.entries[((is_own ? 0 : passive) + j) * size + i] = found->second;
    }
  }
  block.parameters = symbols_in(*graph, block.entries, field_.parameters);
  const std::vector<NodeId> parts = parts_of(*graph, block.entries);
  const auto changes = [&](NodeId id) {
    return (*graph)[id].operation == Operation::symbol && !is_in(field_.parameters, id);
  };
  if (std::ranges::any_of(parts, changes)) return std::nullopt;
  block.values = Tape(*graph, field_.parameters, block.entries);
  return block;
}

}  // namespace gearsweep
