// Expressions of a model: nodes of a graph, in which equal parts are one node.
//
// The grammar of their text (parse.hpp), from what binds least to what binds most:
//   expression := conjunction ("or" conjunction)*
//   conjunction := negation ("and" negation)*
//   negation := "not" negation | comparison
//   comparison := sum (("<" | "<=" | ">" | ">=" | "==") sum)?
//   sum := product (("+" | "-") product)*
//   product := signed (("*" | "/") signed)*
//   signed := ("-" | "+") signed | power
//   power := primary (("^" | "**") signed)?
//   primary := number | name | function "(" expression ("," expression)* ")" | "(" expression ")"
//            | "table" "(" quoted "," expression ("," ("linear" | "cubic"))? ")"
//   quoted := a file's name between " and ", or between ' and '
// A name may have a point in it, as option.choice. Conditions (what compares, and, or, not) and
// numbers are of two kinds; if(condition, yes, no) makes a number of a condition.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "expression/periodic_table.hpp"

namespace gearsweep {

enum class Operation : std::uint8_t {
  number,
  symbol,
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  arctangent_of_two,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  square_root,
  square_root_above_one,  // (x): sqrt(1 + x) - 1
  absolute,
  sign,
  floor,
  min,
  max,
  backlash,  // (x, b): max(x - b, 0) + min(x + b, 0)
  stop,      // (x, b): max(x - b, 0)
  less,
  less_or_equal,
  equal,
  conjunction,
  disjunction,
  negation,
  select,  // (condition, yes, no)
  table    // (phase, toward): PeriodicTable::at
};

// A function that is called by name.
struct FunctionInfo {
  std::string_view name;
  Operation operation;
  std::size_t arguments;
};
std::span<const FunctionInfo> functions();

// Number of arguments.
std::size_t arity(Operation operation);
// Whether it gives a condition, not a number.
bool is_condition(Operation operation);
// What it gives, but for a table; conditions are 1 or 0.
double apply(Operation operation, double a, double b, double c);

using NodeId = std::uint32_t;

struct Node {
  Operation operation = Operation::number;
  double number = 0.0;
  std::string symbol;
  std::shared_ptr<const PeriodicTable> table;  // of Operation::table
  std::vector<NodeId> arguments;
  std::size_t depth = 1;  // nodes on the longest way down
};

// Arguments are older than what they are arguments of, so their ids are smaller.
class ExpressionGraph {
 public:
  const Node& operator[](NodeId id) const { return nodes_[id]; }
  std::size_t size() const { return nodes_.size(); }

  NodeId number(double value);
  NodeId symbol(const std::string& name);
  // Tables are told apart by their addresses.
  NodeId table(std::shared_ptr<const PeriodicTable> table, NodeId phase, NodeId toward);
  // The node of what is written, as it is written.
  NodeId as_written(Operation operation, const std::vector<NodeId>& arguments);
  // Simplified by rules that change no value, but for what would not be finite: sums with 0,
  // products with 0 and 1, signs, small whole powers, parts that are numbers.
  NodeId make(Operation operation, const std::vector<NodeId>& arguments);
  // The node with other arguments, simplified.
  NodeId with_arguments(NodeId id, const std::vector<NodeId>& arguments);

  bool is_number(NodeId id, double value) const;
  bool is_number(NodeId id) const { return nodes_[id].operation == Operation::number; }

 private:
  NodeId intern(Node node);
  // A choice of which a branch is 0. A factor goes into the other branch: it need not be finite
  // where that is not chosen.
  bool is_part_zero(NodeId id) const;
  NodeId make_sum(NodeId a, NodeId b);
  NodeId make_difference(NodeId a, NodeId b);
  NodeId make_product(NodeId a, NodeId b);
  NodeId make_quotient(NodeId a, NodeId b);
  NodeId make_power(NodeId base, NodeId exponent);
  NodeId make_whole_power(NodeId base, unsigned exponent);
  NodeId make_negated(NodeId a);

  std::vector<Node> nodes_;
  std::unordered_multimap<std::size_t, NodeId> ids_;  // by hash_of() their nodes
};

// A graph's node made anew, simplified, where `replaced` gives some nodes another meaning. Each
// call of one Rewriter makes a node once.
class Rewriter {
 public:
  Rewriter(ExpressionGraph* graph, std::map<NodeId, NodeId> replaced);
  NodeId operator()(NodeId id);

 private:
  ExpressionGraph* graph_;
  std::unordered_map<NodeId, NodeId> known_;
};

// The nodes that these are made of, themselves included, arguments first.
std::vector<NodeId> parts_of(const ExpressionGraph& graph, const std::vector<NodeId>& roots);

}  // namespace gearsweep
