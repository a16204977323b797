// A number that remembers how it was made, for functions of a model's header: called with it, they
// give the graph of what they work out.
#pragma once

#include <initializer_list>

#include "expression/expression.hpp"

namespace gearsweep {

// A node of a graph, or a number that belongs to none.
class Traced {
 public:
  Traced() = default;
  Traced(double number) : number_(number) {}
  Traced(ExpressionGraph* graph, NodeId node) : graph_(graph), node_(node) {}

  NodeId node_of(ExpressionGraph* graph) const {
    return graph_ == nullptr ? graph->number(number_) : node_;
  }

  Traced operator-() const { return made(Operation::negate, {*this}); }
  friend Traced operator+(const Traced& a, const Traced& b) { return made(Operation::add, {a, b}); }
  friend Traced operator-(const Traced& a, const Traced& b) {
    return made(Operation::subtract, {a, b});
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    return made(Operation::multiply, {a, b});
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    return made(Operation::divide, {a, b});
  }
  // A condition: what traced_select() takes.
  friend Traced operator<(const Traced& a, const Traced& b) {
    return made(Operation::less, {a, b});
  }
  friend Traced sqrt(const Traced& a) { return made(Operation::square_root, {a}); }
  friend Traced fabs(const Traced& a) { return made(Operation::absolute, {a}); }
  friend Traced traced_select(const Traced& condition, const Traced& yes, const Traced& no) {
    return made(Operation::select, {condition, yes, no});
  }
  friend Traced traced_min(const Traced& a, const Traced& b) {
    return made(Operation::min, {a, b});
  }
  friend Traced traced_max(const Traced& a, const Traced& b) {
    return made(Operation::max, {a, b});
  }

 private:
  static Traced made(Operation operation, std::initializer_list<Traced> arguments) {
    ExpressionGraph* graph = nullptr;
    for (const Traced& argument : arguments) {
      if (argument.graph_ != nullptr) graph = argument.graph_;
    }
    if (graph == nullptr) {
      const auto number = [&](std::size_t i) {
        return i < arguments.size() ? (arguments.begin() + i)->number_ : 0.0;
      };
      return apply(operation, number(0), number(1), number(2));
    }
    std::vector<NodeId> nodes;
    for (const Traced& argument : arguments) nodes.push_back(argument.node_of(graph));
    return {graph, graph->make(operation, nodes)};
  }

  double number_ = 0.0;
  ExpressionGraph* graph_ = nullptr;
  NodeId node_ = 0;
};

}  // namespace gearsweep
