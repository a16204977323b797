#include "equations/detail/one_sided.hpp"

#include <map>

namespace gearsweep {
namespace {

class OneSided {
 public:
  OneSided(ExpressionGraph* graph, NodeId phase, NodeId inside)
      : graph_(graph), to_inside_(graph, {{phase, inside}}) {}

  std::vector<NodeId> run(const std::vector<NodeId>& values) {
    // Arguments come before what they are arguments of.
    for (const NodeId id : parts_of(*graph_, values)) known_[id] = at_break(id);
    std::vector<NodeId> out;
    for (const NodeId id : values) out.push_back(known_.at(id));
    return out;
  }

 private:
  NodeId make(Operation operation, const std::vector<NodeId>& arguments) {
    return graph_->make(operation, arguments);
  }
  NodeId select(NodeId condition, NodeId yes, NodeId no) {
    return make(Operation::select, {condition, yes, no});
  }
  NodeId less(NodeId a, NodeId b) { return make(Operation::less, {a, b}); }
  NodeId number(double value) { return graph_->number(value); }
  NodeId negative(NodeId a) { return make(Operation::negate, {a}); }

  NodeId at_break(NodeId id) {
    const Node node = (*graph_)[id];  // a copy: the graph grows
    if (node.arguments.empty()) return id;
    const bool jumps = is_condition(node.operation) || node.operation == Operation::sign ||
                       node.operation == Operation::floor;
    if (jumps) return to_inside_(id);
    std::vector<NodeId> arguments;
    for (const NodeId argument : node.arguments) arguments.push_back(known_.at(argument));
    if (node.operation == Operation::table) {
      if (!node.table->jumps().empty()) arguments[1] = to_inside_(node.arguments[0]);
      return graph_->with_arguments(id, arguments);
    }
    const NodeId last = node.arguments.back();
    if (to_inside_(last) == last && to_inside_(node.arguments[0]) == node.arguments[0]) {
      return graph_->with_arguments(id, arguments);
    }
    return at_edge(node, std::move(arguments));
  }

  // Rounding may put an argument on the wrong side of a pole, of a cut, or of the place where a
  // function begins. It is on the side where it is inside.
  NodeId at_edge(const Node& node, std::vector<NodeId> arguments) {
    const NodeId zero = number(0.0), one = number(1.0);
    const NodeId first_inside = to_inside_(node.arguments[0]);
    switch (node.operation) {
      case Operation::logarithm:
      case Operation::square_root:
      case Operation::power:
        arguments[0] = select(less(zero, first_inside), make(Operation::max, {arguments[0], zero}),
                              arguments[0]);
        break;
      case Operation::arcsine:
      case Operation::arccosine: {
        const NodeId clamped =
            make(Operation::min, {make(Operation::max, {arguments[0], number(-1.0)}), one});
        const NodeId is_in = less(make(Operation::absolute, {first_inside}), one);
        arguments[0] = select(is_in, clamped, arguments[0]);
        break;
      }
      case Operation::arctangent_of_two: {
        const NodeId size = make(Operation::absolute, {arguments[0]});
        arguments[0] = select(less(first_inside, zero), negative(size), size);
        break;
      }
      case Operation::divide: {
        const NodeId quotient = make(Operation::divide, arguments);
        return turned(quotient, arguments[1], to_inside_(node.arguments[1]));
      }
      case Operation::tangent: {
        const NodeId value = make(Operation::tangent, arguments);
        return turned(value, make(Operation::cosine, arguments),
                      make(Operation::cosine, {first_inside}));
      }
      default:
        break;
    }
    return make(node.operation, arguments);
  }

  // With the other sign where a divisor has not the sign that it has inside.
  NodeId turned(NodeId value, NodeId divisor, NodeId divisor_inside) {
    const NodeId zero = number(0.0);
    if (graph_->is_number(divisor)) return value;
    const NodeId is_above =
        make(Operation::conjunction,
             {less(divisor_inside, zero), make(Operation::less_or_equal, {zero, divisor})});
    const NodeId is_below =
        make(Operation::conjunction, {less(zero, divisor_inside), less(divisor, zero)});
    const NodeId is_wrong = make(Operation::disjunction, {is_above, is_below});
    return select(is_wrong, negative(value), value);
  }

  ExpressionGraph* graph_;
  Rewriter to_inside_;
  std::map<NodeId, NodeId> known_;
};

}  // namespace

std::vector<NodeId> one_sided(ExpressionGraph* graph, NodeId phase, NodeId inside,
                              const std::vector<NodeId>& values) {
  return OneSided(graph, phase, inside).run(values);
}

}  // namespace gearsweep
