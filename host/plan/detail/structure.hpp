// Which state enters whose derivative, and by which equations the states change that a reduced
// model leaves out. All of it is read in the graph of the equations, so that it holds at any state.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "equations/field_graph.hpp"
#include "expression/tape.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Linear equations with coefficients that do not change in time.
struct LinearBlock {
  std::vector<NodeId> entries;  // column by column: nodes made of `parameters`
  std::vector<std::size_t> parameters;
  Tape values;  // the entries, given all parameters of the model
};

// The structure of a study: parameters that are the same at all points count as their numbers, so
// that a coefficient of 0 takes part in nothing.
class Structure {
 public:
  explicit Structure(const Study& study);

  // Whether no rate changes with the phase.
  bool is_autonomous() const;
  // The states that a signal depends on.
  std::set<std::size_t> drivers_of_signal(std::size_t signal) const;
  // These states and all that drive them.
  std::set<std::size_t> closure(std::set<std::size_t> states) const;
  // Whether mirrored states do mirror each other: x[second] = -x[first] in all pairs makes that of
  // their rates.
  bool keeps_mirrored(const std::vector<MirrorPairs::Pair>& mirrors);
  // How what is left out changes, as Reduction::block; nothing where that cannot be shown to be
  // linear and the same at all times.
  std::optional<LinearBlock> left_out(const Reduction& reduction);
  // Whether what depends on one of these states, in the equations of the others and in these
  // signals, is finite at any of their values. Only then a product of it with 0 is 0.
  bool is_finite_whatever(const std::vector<std::size_t>& states,
                          const std::set<std::size_t>& signals) const;

 private:
  std::set<std::size_t> states_in(NodeId id) const;

  FieldGraph field_;                                       // with numbers for parameters
  std::vector<NodeId> symbolic_rates_, symbolic_signals_;  // with symbols for all of them
  std::vector<std::set<std::size_t>> drivers_;             // [state]
};

}  // namespace gearsweep
