// Expressions worked out on the host, in double.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// What some nodes come to, given others. A value type; the graph is not needed any more.
class Tape {
 public:
  Tape() = default;
  // inputs: nodes whose values are given, in this order; all that outputs depend on, but numbers,
  // is among them or made of them.
  Tape(const ExpressionGraph& graph, const std::vector<NodeId>& inputs,
       const std::vector<NodeId>& outputs);

  // The same outputs as functions of the other inputs alone, where the first ones have these
  // values: what follows from these is worked out, and what a choice or a factor 0 leaves out is
  // dropped.
  Tape given(const std::vector<double>& first) const;

  // inputs, outputs: one number for each, in the constructor's order. They may not overlap.
  void run(const double* inputs, double* outputs) const;
  // For many inputs at once. inputs, outputs: [input][count], [output][count]. The same bits.
  void run_many(std::size_t count, const double* inputs, double* outputs) const;
  // As run(), for what has one output.
  double run(const std::vector<double>& inputs) const;
  // All outputs.
  std::vector<double> run_all(const std::vector<double>& inputs) const;

 private:
  struct Step {
    Operation operation;
    std::size_t a, b, c;  // places of its arguments; of a table c: which one
  };

  std::size_t inputs_ = 0;
  std::vector<double> numbers_;  // their places follow those of the inputs
  std::vector<Step> steps_;      // their places follow those of the numbers
  std::vector<std::size_t> outputs_;
  std::vector<std::shared_ptr<const PeriodicTable>> tables_;
};

}  // namespace gearsweep
