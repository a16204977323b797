#include "expression/differentiate.hpp"

#include <map>

namespace gearsweep {
namespace {

class Partials {
 public:
  Partials(ExpressionGraph* graph, NodeId id)
      : graph_(graph), id_(id), node_((*graph)[id]), zero_(number(0.0)), one_(number(1.0)) {}

  std::vector<NodeId> run() {
    switch (node_.operation) {
      case Operation::number:
      case Operation::symbol:
        return {};
      case Operation::negate:
        return {number(-1.0)};
      case Operation::add:
        return {one_, one_};
      case Operation::subtract:
        return {one_, number(-1.0)};
      case Operation::multiply:
        return {b(), a()};
      case Operation::divide:
        return {make(Operation::divide, one_, b()), negative(make(Operation::divide, id_, b()))};
      case Operation::power:
        return of_power();
      case Operation::arctangent_of_two:
        return {make(Operation::divide, b(), sum_of_squares()),
                negative(make(Operation::divide, a(), sum_of_squares()))};
      case Operation::min:
        return chosen(make(Operation::less, b(), a()));
      case Operation::max:
        return chosen(make(Operation::less, a(), b()));
      case Operation::backlash:
        return of_backlash();
      case Operation::stop:
        return {indicator(make(Operation::less, b(), a())),
                negative(indicator(make(Operation::less, b(), a())))};
      case Operation::select:
        return {zero_, indicator(a()), graph_->make(Operation::select, {a(), zero_, one_})};
      case Operation::sign:
      case Operation::floor:
        return {zero_};
      case Operation::table:  // its argument is made of the phase, which is never varied
        return {zero_, zero_};
      default:
        break;
    }
    if (is_condition(node_.operation)) return std::vector<NodeId>(node_.arguments.size(), zero_);
    return {of_function()};
  }

 private:
  NodeId a() const { return node_.arguments[0]; }
  NodeId b() const { return node_.arguments[1]; }
  NodeId number(double value) { return graph_->number(value); }
  NodeId make(Operation operation, NodeId x, NodeId y) { return graph_->make(operation, {x, y}); }
  NodeId make(Operation operation, NodeId x) { return graph_->make(operation, {x}); }
  NodeId negative(NodeId x) { return make(Operation::negate, x); }
  NodeId square(NodeId x) { return make(Operation::multiply, x, x); }
  NodeId inverse(NodeId x) { return make(Operation::divide, one_, x); }
  NodeId indicator(NodeId condition) {
    return graph_->make(Operation::select, {condition, one_, zero_});
  }
  NodeId sum_of_squares() { return make(Operation::add, square(a()), square(b())); }

  // The slope is that of the second argument where the condition holds, else that of the first.
  std::vector<NodeId> chosen(NodeId is_second) {
    return {graph_->make(Operation::select, {is_second, zero_, one_}), indicator(is_second)};
  }

  std::vector<NodeId> of_power() {
    const NodeId less = make(Operation::subtract, b(), one_);
    const NodeId by_base = make(Operation::multiply, b(), make(Operation::power, a(), less));
    if (graph_->is_number(b())) return {by_base, zero_};
    return {by_base, make(Operation::multiply, id_, make(Operation::logarithm, a()))};
  }

  // Each flank that touches counts; where b is negative, both may.
  std::vector<NodeId> of_backlash() {
    const NodeId drive = indicator(make(Operation::less, b(), a()));
    const NodeId back = indicator(make(Operation::less, a(), negative(b())));
    return {make(Operation::add, drive, back), make(Operation::subtract, back, drive)};
  }

  NodeId of_function() {
    switch (node_.operation) {
      case Operation::sine:
        return make(Operation::cosine, a());
      case Operation::cosine:
        return negative(make(Operation::sine, a()));
      case Operation::tangent:
        return make(Operation::add, one_, square(id_));
      case Operation::arcsine:
        return inverse(make(Operation::square_root, make(Operation::subtract, one_, square(a()))));
      case Operation::arccosine:
        return negative(
            inverse(make(Operation::square_root, make(Operation::subtract, one_, square(a())))));
      case Operation::arctangent:
        return inverse(make(Operation::add, one_, square(a())));
      case Operation::hyperbolic_sine:
        return make(Operation::hyperbolic_cosine, a());
      case Operation::hyperbolic_cosine:
        return make(Operation::hyperbolic_sine, a());
      case Operation::hyperbolic_tangent:
        return make(Operation::subtract, one_, square(id_));
      case Operation::exponential:
        return id_;
      case Operation::logarithm:
        return inverse(a());
      case Operation::square_root:
        return make(Operation::divide, number(0.5), id_);
      case Operation::square_root_above_one:
        return make(Operation::divide, number(0.5),
                    make(Operation::square_root, make(Operation::add, one_, a())));
      default:  // absolute
        return graph_->make(Operation::select,
                            {make(Operation::less, a(), zero_), number(-1.0), one_});
    }
  }

  ExpressionGraph* graph_;
  const NodeId id_;
  const Node node_;  // a copy: the graph grows
  const NodeId zero_, one_;
};

}  // namespace

std::vector<NodeId> partial_derivatives(ExpressionGraph* graph, NodeId id) {
  return Partials(graph, id).run();
}

NodeId derivative(ExpressionGraph* graph, NodeId of, NodeId by) {
  const NodeId zero = graph->number(0.0);
  std::map<NodeId, NodeId> known;
  for (const NodeId id : parts_of(*graph, {of})) {
    if (id == by) {
      known[id] = graph->number(1.0);
      continue;
    }
    const std::vector<NodeId> arguments = (*graph)[id].arguments;
    const auto changes = [&](NodeId argument) { return known.at(argument) != zero; };
    NodeId sum = zero;
    bool is_changed = false;
    for (const NodeId argument : arguments) is_changed = is_changed || changes(argument);
    if (is_changed) {
      const std::vector<NodeId> partials = partial_derivatives(graph, id);
      for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (!changes(arguments[i])) continue;
        const NodeId term = graph->make(Operation::multiply, {partials[i], known.at(arguments[i])});
        sum = graph->make(Operation::add, {sum, term});
      }
    }
    known[id] = sum;
  }
  return known.at(of);
}

NodeId derivative_along(ExpressionGraph* graph, NodeId id, const std::vector<NodeId>& symbols,
                        const std::vector<NodeId>& by) {
  NodeId all = graph->number(0.0);
  for (std::size_t i = 0; i < by.size(); ++i) {
    const NodeId slope = derivative(graph, id, symbols[i]);
    all = graph->make(Operation::add, {all, graph->make(Operation::multiply, {slope, by[i]})});
  }
  return all;
}

}  // namespace gearsweep
