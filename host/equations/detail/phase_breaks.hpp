// Where in a period expressions of the phase jump, or have a corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "equations/detail/break_memory.hpp"
#include "expression/interval.hpp"
#include "expression/print.hpp"
#include "expression/tape.hpp"

namespace gearsweep {

inline constexpr double kWholePhase = 2.0 * std::numbers::pi;  // of a period, in radians

// Corners of linear tables, beyond which these are no breaks: each would take a step of its own.
inline constexpr std::size_t kMaxTableCorners = 100;

// The breaks of some expressions of the phase and of parameters: where what a condition compares is
// equal, where an argument of `sign` or `abs` is 0 and one of `floor` whole, where `min` changes
// its choice, where a fraction has a pole, a root begins, a table jumps or bends. Between two
// breaks the expressions are smooth. A value type; the graph is not needed any more.
//
// How they are found: breaks of inner parts first. Between these, all inner choices are fixed, so
// that an argument is a smooth function of the phase. Its values and slopes over an interval are
// enclosed; the interval is halved until the enclosure excludes a break, or the slope has one sign.
// So no break is missed but those that are closer than 2e-8 of a period to another one or to phase
// 0, and so change no more than that short piece.
class PhaseBreaks {
 public:
  PhaseBreaks() = default;
  // inputs: symbols whose values are given to find(); all that the roots depend on beside the
  // phase. The last one is the turn. names: for texts.
  PhaseBreaks(const ExpressionGraph& graph, const std::vector<NodeId>& inputs, NodeId phase,
              const std::vector<NodeId>& roots, const NodeNames& names);

  // Phases in radians, above 0 and below 2 pi, rising. Throws InputError, with the expression,
  // where there are more than 1,000, or where it cannot be told what an expression does.
  std::vector<double> find(const std::vector<double>& inputs) const;
  // The same for each value 0, 1, ... of the last input.
  std::vector<std::vector<double>> find_in_turns(std::vector<double> inputs,
                                                 std::size_t turns) const;
  // What breaks, each once.
  std::vector<std::string> texts() const;
  // What says so of tables that have too many corners.
  const std::vector<std::string>& tables_left_out() const { return tables_left_out_; }

 private:
  class Reader;
  class Search;

  // Places of values: the phase, then what the phase does not change, then steps.
  struct Step {
    Operation operation;
    std::size_t a = 0, b = 0, c = 0;
    std::shared_ptr<const PeriodicTable> table;
    bool is_condition = false;
  };

  enum class Levels : std::uint8_t {
    zero,
    whole,  // all whole numbers
    poles,  // of the tangent
    table   // phases of a table, in each turn
  };

  // A function of places: value(a) + sign value(b) + offset; where it is at one of its levels,
  // there may be a break.
  struct Function {
    std::size_t a = 0, b = 0;
    double sign = 0.0, offset = 0.0;
    Levels levels = Levels::zero;
    std::vector<double> phases;  // of Levels::table, in [0, 2 pi), rising
  };

  // A step that may break.
  struct Breaker {
    std::size_t step = 0;
    std::vector<Function> functions;
    std::vector<std::size_t> cone;  // steps that it is made of, rising
    std::string text;
  };

  std::size_t first_step() const { return 1 + constant_count_; }
  std::vector<double> search(const std::vector<double>& inputs) const;
  std::vector<std::size_t> steps_below(std::size_t step) const;
  void find_deciding();
  void order_breakers(const std::vector<std::size_t>& roots);

  Tape constants_;
  std::size_t constant_count_ = 0;
  std::vector<std::size_t> deciding_;  // constants that say where a break is
  std::vector<Step> steps_;
  std::vector<std::size_t> roots_;  // places
  std::vector<std::size_t> ranks_;  // [step]: when it is known, conditions before what they choose
  std::vector<Breaker> breakers_;   // by rank
  std::vector<std::string> tables_left_out_;
  std::shared_ptr<BreakMemory> memory_ = std::make_shared<BreakMemory>();  // of all copies
};

}  // namespace gearsweep
