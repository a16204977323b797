#include "equations/detail/inner_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gearsweep {

InnerLoop::InnerLoop(Formula* formula, Lowered* lowered)
    : formula_(formula), graph_(&formula->graph), lowered_(lowered), dependences_(*formula) {}

void InnerLoop::count_uses(const std::vector<NodeId>& roots) {
  for (const NodeId id : parts_of(*graph_, roots)) {
    for (const NodeId argument : (*graph_)[id].arguments) ++uses_[argument];
  }
  for (const NodeId id : roots) ++uses_[id];
}

NodeId InnerLoop::arranged(NodeId id) {
  if (const auto before = known(id)) return *before;
  const NodeId made = make_arranged(id);
  arranged_.emplace(id, made);
  return made;
}

std::optional<NodeId> InnerLoop::known(NodeId id) const {
  const auto found = arranged_.find(id);
  return found == arranged_.end() ? std::nullopt : std::optional(found->second);
}

NodeId InnerLoop::make_arranged(NodeId id) {
  const Node node = (*graph_)[id];  // a copy: the graph grows
  if (graph_->is_number(id)) return id;
  const Dependence depends = dependence_of(id);
  if (!depends.state && !depends.phase) {
    return has_phase_ && !depends.swept && depends.rounds ? coef(id) : point_field(id);
  }
  if (!depends.state && !depends.swept) return coef(id);
  switch (node.operation) {
    case Operation::add:
    case Operation::subtract:
      return sum(id);
    case Operation::multiply:
    case Operation::divide:
      return product(id);
    case Operation::negate:
      return graph_->make(Operation::negate, {arranged(node.arguments[0])});
    case Operation::symbol:
      return id;  // of a state
    default:
      break;
  }
  if (!depends.state) return coef(id);
  if (is_condition(node.operation) || node.operation == Operation::select) return chosen(node);
  std::vector<NodeId> arguments;
  for (const NodeId argument : node.arguments) arguments.push_back(arranged(argument));
  return graph_->make(node.operation, arguments);
}

// Conditions that no state changes become numbers: only these can be tabulated.
NodeId InnerLoop::chosen(const Node& node) {
  std::vector<NodeId> arguments;
  for (const NodeId argument : node.arguments) {
    if (!is_condition((*graph_)[argument].operation) || dependence_of(argument).state) {
      arguments.push_back(arranged(argument));
      continue;
    }
    const NodeId one = graph_->number(1.0), zero = graph_->number(0.0);
    const NodeId as_number = arranged(graph_->make(Operation::select, {argument, one, zero}));
    arguments.push_back(make(Operation::less, zero, as_number));
  }
  return graph_->make(node.operation, arguments);
}

NodeId InnerLoop::point_field(NodeId id) {
  const auto known = std::ranges::find(lowered_->point_values, id);
  const auto index = static_cast<std::size_t>(known - lowered_->point_values.begin());
  if (known == lowered_->point_values.end()) {
    lowered_->point_values.push_back(id);
    lowered_->point.push_back(graph_->symbol(fmt::format("point->c{}", index)));
  }
  return lowered_->point[index];
}

NodeId InnerLoop::coef(NodeId id) {
  const auto known = std::ranges::find(lowered_->coef_values, id);
  const auto index = static_cast<std::size_t>(known - lowered_->coef_values.begin());
  if (known == lowered_->coef_values.end()) {
    lowered_->coef_values.push_back(id);
    lowered_->coefs.push_back(graph_->symbol(fmt::format("phase->w{}", index)));
    for (const NodeId part : parts_of(*graph_, {id})) {
      const auto parameter = std::ranges::find(formula_->parameters, part);
      if (parameter == formula_->parameters.end()) continue;
      lowered_->shapes_phase[static_cast<std::size_t>(parameter - formula_->parameters.begin())] =
          true;
    }
  }
  return lowered_->coefs[index];
}

// The parts of a sum, or of a product; what is used elsewhere, too, stays whole.
void InnerLoop::take_apart(NodeId id, bool is_product, bool is_inverse, bool is_root,
                           std::vector<Part>* parts, bool* is_negative) {
  const Node node = (*graph_)[id];
  const Operation join = is_product ? Operation::multiply : Operation::add;
  const Operation part = is_product ? Operation::divide : Operation::subtract;
  const bool is_shared = !is_root && uses_[id] > 1;
  if (!is_shared && (node.operation == join || node.operation == part)) {
    take_apart(node.arguments[0], is_product, is_inverse, false, parts, is_negative);
    take_apart(node.arguments[1], is_product, is_inverse != (node.operation == part), false, parts,
               is_negative);
  } else if (!is_shared && node.operation == Operation::negate) {
    if (is_product) *is_negative = !*is_negative;
    take_apart(node.arguments[0], is_product, is_inverse != !is_product, false, parts, is_negative);
  } else {
    parts->push_back({id, is_inverse});
  }
}

NodeId InnerLoop::joined(NodeId left, const Part& part, bool is_product) {
  const Operation operation = is_product
                                  ? (part.is_inverse ? Operation::divide : Operation::multiply)
                                  : (part.is_inverse ? Operation::subtract : Operation::add);
  return make(operation, left, part.id);
}

// What no state changes goes together, and first: of the point alone, of the phase alone, of
// both. The evaluations of a step share it. The others follow, those that wait longest for the
// states last.
NodeId InnerLoop::join(NodeId id, bool is_product, bool* is_negative) {
  std::vector<Part> parts;
  take_apart(id, is_product, false, true, &parts, is_negative);
  const NodeId neutral = graph_->number(is_product ? 1.0 : 0.0);
  NodeId of_point = neutral, of_all = neutral, of_phase = neutral;
  std::vector<Part> rest;
  for (const Part& part : parts) {
    const Dependence depends = dependence_of(part.id);
    if (!depends.state && !depends.phase) {
      const bool is_tabulated = has_phase_ && depends.rounds;
      NodeId& constant = depends.swept ? of_point : is_tabulated ? of_phase : of_all;
      constant = joined(constant, part, is_product);
    } else if (!depends.state && !depends.swept) {
      of_phase = joined(of_phase, part, is_product);
    } else if (is_product && part.is_inverse && !depends.state) {
      rest.push_back({coef(make(Operation::divide, neutral, part.id)), false});
    } else {
      const NodeId made = arranged(part.id);
      rest.push_back(
          {made, part.is_inverse, {depends.state, depends.velocity, (*graph_)[made].depth}});
    }
  }
  std::ranges::stable_sort(rest, {}, &Part::wait);
  // What is the same for all points goes with what is there.
  const bool has_phase_alone = of_point == neutral && of_phase != neutral;
  NodeId& host = has_phase_alone ? of_phase : of_point;
  host = joined(host, {of_all, false}, is_product);
  NodeId all = arranged(of_point);
  all = joined(all, {arranged(of_phase), false}, is_product);
  // Where two products are added, the second one is worked out first: the sum is fused with the
  // other.
  const bool is_plain = !is_product && all == neutral && rest.size() > 1;
  if (is_plain && !rest[0].is_inverse && !rest[1].is_inverse) std::swap(rest[0], rest[1]);
  for (const Part& part : rest) all = joined(all, part, is_product);
  return all;
}

NodeId InnerLoop::sum(NodeId id) {
  bool is_negative = false;
  return join(id, false, &is_negative);
}

bool InnerLoop::is_of_point(NodeId id) {
  const Dependence& depends = dependence_of(id);
  return !depends.state && !depends.phase;
}

std::vector<InnerLoop::Part> InnerLoop::factors_of(NodeId id, bool is_root, bool* is_negative) {
  std::vector<Part> factors;
  take_apart(id, true, false, is_root, &factors, is_negative);
  return factors;
}

// A product of what belongs to the point with one sum, as a sum of products: c (k x + d v + f)
// becomes (c k) x + (c d) v + c f, with an operation less. Unchanged where more than one part of
// the sum would need a multiplication of its own.
NodeId InnerLoop::distributed(NodeId id) {
  bool is_negative = false;
  NodeId factor = graph_->number(1.0);
  std::vector<NodeId> others;
  for (const Part& part : factors_of(id, true, &is_negative)) {
    if (is_of_point(part.id)) {
      factor = joined(factor, part, true);
    } else {
      others.push_back(part.id);
      if (part.is_inverse) return id;
    }
  }
  if (others.size() != 1 || uses_[others[0]] > 1 || graph_->is_number(factor)) return id;
  if (!dependence_of(others[0]).state) return id;
  const Operation operation = (*graph_)[others[0]].operation;
  if (operation != Operation::add && operation != Operation::subtract) return id;
  std::vector<Part> terms;
  take_apart(others[0], false, false, true, &terms, &is_negative);
  int bare = 0;
  for (const Part& term : terms) {
    bool is_turned = false;
    const std::vector<Part> own = factors_of(term.id, false, &is_turned);
    if (std::ranges::none_of(own, [&](const Part& part) { return is_of_point(part.id); })) ++bare;
  }
  if (bare > 1) return id;
  NodeId all = graph_->number(0.0);
  for (const Part& term : terms) {
    const NodeId product = make(Operation::multiply, factor, term.id);
    all = joined(all, {product, term.is_inverse != is_negative}, false);
  }
  return all;
}

NodeId InnerLoop::product(NodeId id) {
  const NodeId sum = distributed(id);
  if (sum != id) return arranged(sum);
  bool is_negative = false;
  const NodeId all = join(id, true, &is_negative);
  return is_negative ? graph_->make(Operation::negate, {all}) : all;
}

}  // namespace gearsweep
