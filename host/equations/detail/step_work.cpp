#include "equations/detail/step_work.hpp"

#include <set>

namespace gearsweep {
namespace {

// A comparison counts 1, and so a minimum; choosing by it and a change of sign are free.
double flops_of(Operation operation, bool may_be_negative) {
  switch (operation) {
    case Operation::number:
    case Operation::symbol:
    case Operation::table:
    case Operation::negate:
    case Operation::select:
    case Operation::conjunction:
    case Operation::disjunction:
    case Operation::negation:
      return 0.0;
    case Operation::stop:
      return 2.0;
    case Operation::backlash:
      return may_be_negative ? 5.0 : 3.0;
    default:
      return 1.0;
  }
}

class Counter {
 public:
  Counter(const ExpressionGraph& graph, const Lowered& lowered) : graph_(graph) {
    for (const Contact& contact : lowered.contacts.list) {
      if (!contact.may_be_negative) clamped_.insert(contact.corner);
    }
  }

  // The operations of these values that change with one of the symbols and not with one of
  // `without`.
  double count(const std::vector<NodeId>& values, const std::vector<NodeId>& symbols,
               const std::vector<NodeId>& without) const {
    std::set<NodeId> changing(symbols.begin(), symbols.end());
    std::set<NodeId> other(without.begin(), without.end());
    double flops = 0.0;
    for (const NodeId id : parts_of(graph_, values)) {
      const Node& node = graph_[id];
      for (const NodeId argument : node.arguments) {
        if (changing.contains(argument)) changing.insert(id);
        if (other.contains(argument)) other.insert(id);
      }
      if (node.arguments.empty() || !changing.contains(id) || other.contains(id)) continue;
      flops += flops_of(node.operation, !clamped_.contains(id));
    }
    return flops;
  }

 private:
  const ExpressionGraph& graph_;
  std::set<NodeId> clamped_;  // backlashes that are never negative
};

std::vector<NodeId> joined(std::vector<NodeId> one, const std::vector<NodeId>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

}  // namespace

StepWork step_work_of(const Formula& formula, const Lowered& lowered,
                      const TangentProgram& tangent) {
  const Counter counter(formula.graph, lowered);
  const std::vector<NodeId> moment = joined(formula.states, lowered.coefs);
  StepWork work;
  work.of_state = counter.count(lowered.equations, formula.states, {});
  work.of_phase = counter.count(lowered.equations, lowered.coefs, formula.states);
  work.of_linearization = counter.count(tangent.field_values, moment, {});
  work.of_tangent = counter.count(tangent.rows, joined(tangent.tangent, tangent.base), {});
  return work;
}

}  // namespace gearsweep
