#include "equations/detail/tangent_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "equations/detail/linearization.hpp"

namespace gearsweep {
namespace {

class Builder {
 public:
  Builder(Formula* formula, const Lowered& lowered)
      : states_(formula->states.size()),
        formula_(formula),
        graph_(&formula->graph),
        lowered_(lowered) {
    for (std::size_t i = 0; i < lowered.point.size(); ++i) {
      of_parameters_[lowered.point[i]] = lowered.point_values[i];
    }
  }

  TangentProgram run() {
    std::vector<NodeId> outputs = lowered_.equations;
    for (const Contact& contact : lowered_.contacts.list) {
      outputs.push_back(contact.deflection);
      outputs.push_back(contact.backlash);
    }
    linear_ = linearize(formula_, outputs);
    count_uses();
    find_late();
    out_.scale = graph_->symbol("scale of rows");  // no name of a user's has a space
    for (std::size_t i = 0; i < states_; ++i) {
      out_.tangent.push_back(graph_->symbol(fmt::format("w[{}]", i)));
      out_.base.push_back(graph_->symbol(fmt::format("base[{}]", i)));
    }
    tangents_ = out_.tangent;
    const NodeId zero = graph_->number(0.0);
    for (const LinearSum& part : linear_.parts) {
      tangents_.push_back(sum_of(latest_inside(part), zero, false));
    }
    for (std::size_t i = 0; i < states_; ++i) {
      out_.rows.push_back(sum_of(linear_.outputs[i], out_.base[i], true));
    }
    for (std::size_t i = states_; i < outputs.size(); ++i) {
      out_.contacts.push_back(sum_of(linear_.outputs[i], zero, false));
    }
    return std::move(out_);
  }

 private:
  // Whether states, then shared parts, wait for the velocities: these are what a stage ends with.
  void find_late() {
    for (std::size_t i = 0; i < states_; ++i) {
      are_late_.push_back(lowered_.is_second_order && i >= states_ / 2);
    }
    for (const LinearSum& part : linear_.parts) {
      are_late_.push_back(
          std::ranges::any_of(part, [&](const LinearTerm& term) { return is_late(term.of); }));
    }
  }
  bool is_late(std::size_t of) const { return are_late_[of]; }

  // In an order in which what waits longest is added last. Of the first two products the second
  // one is worked out first, since the sum is fused with the other.
  LinearSum latest_inside(LinearSum sum) const {
    std::stable_partition(sum.begin(), sum.end(),
                          [&](const LinearTerm& term) { return !is_late(term.of); });
    if (sum.size() > 1) std::swap(sum[0], sum[1]);
    return sum;
  }

  // Whether neither states nor the phase change it.
  bool is_of_point(NodeId id) {
    const auto known = are_of_point_.find(id);
    if (known != are_of_point_.end()) return known->second;
    const bool is_other =
        id == out_.scale || std::ranges::find(formula_->states, id) != formula_->states.end() ||
        std::ranges::find(lowered_.coefs, id) != lowered_.coefs.end() ||
        std::ranges::find(lowered_.surfaces, id, &Surface::side) != lowered_.surfaces.end();
    const std::vector<NodeId> arguments = (*graph_)[id].arguments;
    const bool is = !is_other && std::ranges::all_of(arguments, [&](NodeId argument) {
      return is_of_point(argument);
    });
    are_of_point_.emplace(id, is);
    return is;
  }

  // With the parts that neither states nor the phase change as symbols of the point.
  NodeId prepared(NodeId id) {
    const auto known = prepared_.find(id);
    if (known != prepared_.end()) return known->second;
    const NodeId made = make_prepared(id);
    prepared_.emplace(id, made);
    return made;
  }

  NodeId make_prepared(NodeId id) {
    const Node node = (*graph_)[id];
    const bool is_sign = node.operation == Operation::negate;
    if (node.arguments.empty() || (is_sign && (*graph_)[node.arguments[0]].arguments.empty())) {
      return id;
    }
    // A point holds numbers: a condition is worked out from these.
    if (is_of_point(id) && !is_condition(node.operation)) return point_symbol(id);
    if (node.operation == Operation::multiply) return prepared_product(id);
    if (is_sum(node)) {
      const NodeId collected = with_like_terms_together(id);
      if (collected != id) return prepared(collected);
    }
    std::vector<NodeId> arguments;
    for (const NodeId argument : node.arguments) arguments.push_back(prepared(argument));
    return graph_->make(node.operation, arguments);
  }

  // A number times factors, in the order of their ids.
  using Terms = std::map<std::vector<NodeId>, double>;

  bool is_sum(const Node& node) const {
    return node.operation == Operation::add || node.operation == Operation::subtract;
  }

  // x*(c*x) + (x + x)*(c*x) as 3*c*x*x: the rule for products leaves such sums behind. Unchanged
  // where no two terms are alike.
  NodeId with_like_terms_together(NodeId id) {
    Terms terms;
    const std::size_t count = take_terms(id, 1.0, &terms);
    if (terms.size() == count) return id;
    NodeId all = graph_->number(0.0);
    for (const auto& [factors, number] : terms) {
      NodeId term = graph_->number(std::fabs(number));
      for (const NodeId factor : factors) {
        term = graph_->make(Operation::multiply, {term, factor});
      }
      all = graph_->make(number < 0.0 ? Operation::subtract : Operation::add, {all, term});
    }
    return all;
  }

  // How many there were. What is used elsewhere, too, stays whole.
  std::size_t take_terms(NodeId id, double number, Terms* terms) {
    const Node node = (*graph_)[id];
    if (is_sum(node) && uses_[id] < 2) {
      const double sign = node.operation == Operation::subtract ? -1.0 : 1.0;
      return take_terms(node.arguments[0], number, terms) +
             take_terms(node.arguments[1], sign * number, terms);
    }
    std::vector<NodeId> factors;
    take_numbered_factors(id, &number, &factors);
    std::ranges::sort(factors);
    (*terms)[factors] += number;
    return 1;
  }

  void take_numbered_factors(NodeId id, double* number, std::vector<NodeId>* factors) {
    const Node node = (*graph_)[id];
    if (node.operation == Operation::number) {
      *number *= node.number;
    } else if (node.operation == Operation::negate) {
      *number = -*number;
      take_numbered_factors(node.arguments[0], number, factors);
    } else if (node.operation == Operation::multiply && uses_[id] < 2) {
      for (const NodeId argument : node.arguments) {
        take_numbered_factors(argument, number, factors);
      }
    } else if (node.operation == Operation::add && node.arguments[0] == node.arguments[1]) {
      *number *= 2.0;
      take_numbered_factors(node.arguments[0], number, factors);
    } else {
      factors->push_back(id);
    }
  }

  // What belongs to the point first, then the factors that most other parts have, too: products
  // that begin alike share their beginning.
  NodeId prepared_product(NodeId id) {
    std::vector<NodeId> factors;
    for (const NodeId argument : (*graph_)[id].arguments) take_factors(argument, &factors);
    const NodeId one = graph_->number(1.0);
    NodeId of_point = one;
    std::vector<NodeId> others;
    for (const NodeId factor : factors) {
      if (is_of_point(factor)) {
        of_point = graph_->make(Operation::multiply, {of_point, factor});
      } else {
        others.push_back(factor);
      }
    }
    std::ranges::stable_sort(others, std::greater<>(),
                             [&](NodeId factor) { return uses_[factor]; });
    NodeId all = prepared(of_point);
    for (const NodeId factor : others) {
      all = graph_->make(Operation::multiply, {all, prepared(factor)});
    }
    return all;
  }

  // What is used elsewhere, too, stays whole.
  void take_factors(NodeId id, std::vector<NodeId>* factors) {
    const Node node = (*graph_)[id];
    if (node.operation != Operation::multiply || uses_[id] > 1) {
      factors->push_back(id);
      return;
    }
    for (const NodeId argument : node.arguments) take_factors(argument, factors);
  }

  void count_uses() {
    std::vector<NodeId> coefficients;
    for (const std::vector<LinearSum>& sums : {linear_.parts, linear_.outputs}) {
      for (const LinearSum& sum : sums) {
        for (const LinearTerm& term : sum) coefficients.push_back(term.coefficient);
      }
    }
    for (const NodeId id : parts_of(*graph_, coefficients)) {
      for (const NodeId argument : (*graph_)[id].arguments) ++uses_[argument];
    }
  }

  NodeId point_symbol(NodeId id) {
    const NodeId value = Rewriter(graph_, of_parameters_)(id);
    if (graph_->is_number(value)) return value;
    const auto known = std::ranges::find(out_.point_values, value);
    const auto index = static_cast<std::size_t>(known - out_.point_values.begin());
    if (known == out_.point_values.end()) {
      out_.point_values.push_back(value);
      out_.point.push_back(graph_->symbol(fmt::format("prepared[{}]", index)));
    }
    return out_.point[index];
  }

  // The coefficient, times the scale if is_scaled, as what the tangent's statements read: a field,
  // or a symbol of the point where that has it already.
  NodeId field(NodeId coefficient, bool is_scaled) {
    NodeId value = prepared(coefficient);
    if (is_scaled) value = graph_->make(Operation::multiply, {value, out_.scale});
    if (!is_scaled && is_of_point(value)) return value;
    const auto known = std::ranges::find(out_.field_values, value);
    const auto index = static_cast<std::size_t>(known - out_.field_values.begin());
    if (known == out_.field_values.end()) {
      out_.field_values.push_back(value);
      out_.fields.push_back(graph_->symbol(fmt::format("field[{}]", index)));
    }
    return out_.fields[index];
  }

  // base + the terms. A coefficient's sign goes into the sum, so that two that differ in it alone
  // share a field.
  NodeId sum_of(const LinearSum& sum, NodeId base, bool is_scaled) {
    NodeId all = base;
    for (const LinearTerm& term : sum) {
      const Node node = (*graph_)[term.coefficient];
      const bool is_negative = node.operation == Operation::negate ||
                               (node.operation == Operation::number && node.number < 0.0);
      const NodeId size =
          is_negative ? graph_->make(Operation::negate, {term.coefficient}) : term.coefficient;
      const NodeId product =
          graph_->make(Operation::multiply, {field(size, is_scaled), tangents_[term.of]});
      all = graph_->make(is_negative ? Operation::subtract : Operation::add, {all, product});
    }
    return all;
  }

  const std::size_t states_;
  Formula* formula_;
  ExpressionGraph* graph_;
  const Lowered& lowered_;
  std::map<NodeId, NodeId> of_parameters_;  // what the point's symbols are made of
  Linearization linear_;
  std::map<NodeId, std::size_t> uses_;  // by how many parts of the coefficients
  std::map<NodeId, bool> are_of_point_;
  std::map<NodeId, NodeId> prepared_;
  std::vector<bool> are_late_;    // of states, then of shared parts
  std::vector<NodeId> tangents_;  // of states, then of shared parts
  TangentProgram out_;
};

}  // namespace

TangentProgram tangent_program(Formula* formula, const Lowered& lowered) {
  return Builder(formula, lowered).run();
}

}  // namespace gearsweep
