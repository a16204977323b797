#include "expression/expression.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace gearsweep {
namespace {

constexpr std::array kFunctions = {FunctionInfo{"sin", Operation::sine, 1},
                                   FunctionInfo{"cos", Operation::cosine, 1},
                                   FunctionInfo{"tan", Operation::tangent, 1},
                                   FunctionInfo{"asin", Operation::arcsine, 1},
                                   FunctionInfo{"acos", Operation::arccosine, 1},
                                   FunctionInfo{"atan", Operation::arctangent, 1},
                                   FunctionInfo{"atan2", Operation::arctangent_of_two, 2},
                                   FunctionInfo{"sinh", Operation::hyperbolic_sine, 1},
                                   FunctionInfo{"cosh", Operation::hyperbolic_cosine, 1},
                                   FunctionInfo{"tanh", Operation::hyperbolic_tangent, 1},
                                   FunctionInfo{"exp", Operation::exponential, 1},
                                   FunctionInfo{"log", Operation::logarithm, 1},
                                   FunctionInfo{"sqrt", Operation::square_root, 1},
                                   FunctionInfo{"sqrt1pm1", Operation::square_root_above_one, 1},
                                   FunctionInfo{"abs", Operation::absolute, 1},
                                   FunctionInfo{"sign", Operation::sign, 1},
                                   FunctionInfo{"floor", Operation::floor, 1},
                                   FunctionInfo{"min", Operation::min, 2},
                                   FunctionInfo{"max", Operation::max, 2},
                                   FunctionInfo{"backlash", Operation::backlash, 2},
                                   FunctionInfo{"stop", Operation::stop, 2},
                                   FunctionInfo{"if", Operation::select, 3}};

constexpr unsigned kMaxWholePower = 16;  // that is multiplied out

std::size_t hash_of(const Node& node) {
  std::size_t hash = std::hash<std::string>()(node.symbol);
  // As boost::hash_combine: the constant is 2^64 divided by the golden ratio.
  const auto add = [&hash](std::size_t part) {
    hash ^= part + 0x9e3779b97f4a7c15U + (hash << 6U) + (hash >> 2U);
  };
  add(static_cast<std::size_t>(node.operation));
  add(std::bit_cast<std::uint64_t>(node.number));
  add(std::hash<const void*>()(node.table.get()));
  for (const NodeId argument : node.arguments) add(argument);
  return hash;
}

// Numbers by their bits: one that is none is the same as itself.
bool are_same(const Node& one, const Node& other) {
  return one.operation == other.operation &&
         std::bit_cast<std::uint64_t>(one.number) == std::bit_cast<std::uint64_t>(other.number) &&
         one.table == other.table && one.arguments == other.arguments && one.symbol == other.symbol;
}

}  // namespace

std::span<const FunctionInfo> functions() { return kFunctions; }

std::size_t arity(Operation operation) {
  switch (operation) {
    case Operation::number:
    case Operation::symbol:
      return 0;
    case Operation::negate:
    case Operation::negation:
      return 1;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::power:
    case Operation::less:
    case Operation::less_or_equal:
    case Operation::equal:
    case Operation::conjunction:
    case Operation::disjunction:
    case Operation::table:
      return 2;
    default:
      return std::ranges::find(kFunctions, operation, &FunctionInfo::operation)->arguments;
  }
}

bool is_condition(Operation operation) {
  return operation >= Operation::less && operation <= Operation::negation;
}

NodeId ExpressionGraph::intern(Node node) {
  for (const NodeId argument : node.arguments) {
    node.depth = std::max(node.depth, nodes_[argument].depth + 1);
  }
  const std::size_t hash = hash_of(node);
  const auto [first, last] = ids_.equal_range(hash);
  for (auto known = first; known != last; ++known) {
    if (are_same(nodes_[known->second], node)) return known->second;
  }
  const auto id = static_cast<NodeId>(nodes_.size());
  ids_.emplace(hash, id);
  nodes_.push_back(std::move(node));
  return id;
}

NodeId ExpressionGraph::number(double value) {
  Node node;
  node.number = value == 0.0 ? 0.0 : value;  // -0 is the same number
  return intern(std::move(node));
}

NodeId ExpressionGraph::symbol(const std::string& name) {
  Node node;
  node.operation = Operation::symbol;
  node.symbol = name;
  return intern(std::move(node));
}

NodeId ExpressionGraph::table(std::shared_ptr<const PeriodicTable> table, NodeId phase,
                              NodeId toward) {
  Node node;
  node.operation = Operation::table;
  node.table = std::move(table);
  node.arguments = {phase, toward};
  return intern(std::move(node));
}

NodeId ExpressionGraph::with_arguments(NodeId id, const std::vector<NodeId>& arguments) {
  const Operation operation = nodes_[id].operation;
  if (operation != Operation::table) return make(operation, arguments);
  return table(nodes_[id].table, arguments[0], arguments[1]);
}

NodeId ExpressionGraph::as_written(Operation operation, const std::vector<NodeId>& arguments) {
  // The text has no other way to write a negative number.
  if (operation == Operation::negate && is_number(arguments[0])) {
    return number(-nodes_[arguments[0]].number);
  }
  Node node;
  node.operation = operation;
  node.arguments = arguments;
  return intern(std::move(node));
}

bool ExpressionGraph::is_number(NodeId id, double value) const {
  return is_number(id) && nodes_[id].number == value;
}

NodeId ExpressionGraph::make(Operation operation, const std::vector<NodeId>& arguments) {
  const bool are_numbers =
      std::ranges::all_of(arguments, [this](NodeId argument) { return is_number(argument); });
  if (are_numbers) {
    const auto value = [&](std::size_t i) {
      return i < arguments.size() ? nodes_[arguments[i]].number : 0.0;
    };
    const double result = apply(operation, value(0), value(1), value(2));
    if (std::isfinite(result)) return number(result);
  }
  const NodeId a = arguments[0];
  switch (operation) {
    case Operation::negate:
      return make_negated(a);
    case Operation::add:
      return make_sum(a, arguments[1]);
    case Operation::subtract:
      return make_difference(a, arguments[1]);
    case Operation::multiply:
      return make_product(a, arguments[1]);
    case Operation::divide:
      return make_quotient(a, arguments[1]);
    case Operation::power:
      return make_power(a, arguments[1]);
    case Operation::min:
    case Operation::max:
      if (a == arguments[1]) return a;
      break;
    case Operation::negation:
      if (nodes_[a].operation == Operation::negation) return nodes_[a].arguments[0];
      break;
    case Operation::conjunction:
    case Operation::disjunction: {
      const double neutral = operation == Operation::conjunction ? 1.0 : 0.0;
      if (is_number(a)) return is_number(a, neutral) ? arguments[1] : a;
      if (is_number(arguments[1])) return is_number(arguments[1], neutral) ? a : arguments[1];
      break;
    }
    case Operation::select:
      if (is_number(a)) return is_number(a, 0.0) ? arguments[2] : arguments[1];
      if (arguments[1] == arguments[2]) return arguments[1];
      break;
    default:
      break;
  }
  return as_written(operation, arguments);
}

NodeId ExpressionGraph::make_negated(NodeId a) {
  const Node& node = nodes_[a];
  if (node.operation == Operation::negate) return node.arguments[0];
  if (node.operation == Operation::subtract) {
    return make_difference(node.arguments[1], node.arguments[0]);
  }
  return as_written(Operation::negate, {a});
}

NodeId ExpressionGraph::make_sum(NodeId a, NodeId b) {
  if (is_number(a, 0.0)) return b;
  if (is_number(b, 0.0)) return a;
  if (nodes_[b].operation == Operation::negate) return make_difference(a, nodes_[b].arguments[0]);
  if (nodes_[a].operation == Operation::negate) return make_difference(b, nodes_[a].arguments[0]);
  if (is_part_zero(a) && is_part_zero(b) && nodes_[a].arguments[0] == nodes_[b].arguments[0]) {
    const std::vector<NodeId> one = nodes_[a].arguments, other = nodes_[b].arguments;
    return make(Operation::select,
                {one[0], make_sum(one[1], other[1]), make_sum(one[2], other[2])});
  }
  return as_written(Operation::add, {std::min(a, b), std::max(a, b)});
}

NodeId ExpressionGraph::make_difference(NodeId a, NodeId b) {
  if (is_number(b, 0.0)) return a;
  if (is_number(a, 0.0)) return make_negated(b);
  if (a == b) return number(0.0);
  if (nodes_[b].operation == Operation::negate) return make_sum(a, nodes_[b].arguments[0]);
  return as_written(Operation::subtract, {a, b});
}

bool ExpressionGraph::is_part_zero(NodeId id) const {
  const Node& node = nodes_[id];
  return node.operation == Operation::select &&
         (is_number(node.arguments[1], 0.0) || is_number(node.arguments[2], 0.0));
}

NodeId ExpressionGraph::make_product(NodeId a, NodeId b) {
  if (is_number(b)) std::swap(a, b);
  if (is_number(a, 0.0)) return a;
  if (is_number(a, 1.0)) return b;
  if (is_number(a, -1.0)) return make_negated(b);
  if (nodes_[a].operation == Operation::negate) {
    return make_negated(make_product(nodes_[a].arguments[0], b));
  }
  if (nodes_[b].operation == Operation::negate) {
    return make_negated(make_product(a, nodes_[b].arguments[0]));
  }
  if (is_number(a) && nodes_[b].operation == Operation::multiply &&
      is_number(nodes_[b].arguments[0])) {
    const double factor = nodes_[a].number * nodes_[nodes_[b].arguments[0]].number;
    return make_product(number(factor), nodes_[b].arguments[1]);
  }
  for (const auto& [factor, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (!is_part_zero(factor)) continue;
    const std::vector<NodeId> branches = nodes_[factor].arguments;
    const NodeId yes = make_product(branches[1], other);
    return make(Operation::select, {branches[0], yes, make_product(branches[2], other)});
  }
  if (!is_number(a) && a > b) std::swap(a, b);
  return as_written(Operation::multiply, {a, b});
}

NodeId ExpressionGraph::make_quotient(NodeId a, NodeId b) {
  if (is_number(a, 0.0) || is_number(b, 1.0)) return a;
  if (is_number(b, -1.0)) return make_negated(a);
  if (nodes_[a].operation == Operation::negate) {
    return make_negated(make_quotient(nodes_[a].arguments[0], b));
  }
  if (nodes_[b].operation == Operation::negate) {
    return make_negated(make_quotient(a, nodes_[b].arguments[0]));
  }
  return as_written(Operation::divide, {a, b});
}

NodeId ExpressionGraph::make_power(NodeId base, NodeId exponent) {
  if (!is_number(exponent)) return as_written(Operation::power, {base, exponent});
  const double value = nodes_[exponent].number;
  if (value == 0.5) return make(Operation::square_root, {base});
  if (value != std::floor(value) || std::fabs(value) > kMaxWholePower) {
    return as_written(Operation::power, {base, exponent});
  }
  const NodeId whole = make_whole_power(base, static_cast<unsigned>(std::fabs(value)));
  return value < 0.0 ? make_quotient(number(1.0), whole) : whole;
}

NodeId ExpressionGraph::make_whole_power(NodeId base, unsigned exponent) {
  if (exponent == 0) return number(1.0);
  if (exponent == 1) return base;
  const NodeId root = make_whole_power(base, exponent / 2);
  const NodeId square = make_product(root, root);
  return exponent % 2 == 0 ? square : make_product(square, base);
}

}  // namespace gearsweep
