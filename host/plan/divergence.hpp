// The divergence of a model's field, which the Lyapunov exponents of any motion sum to where it is
// the same everywhere.
#pragma once

#include <optional>

#include "equations/field_graph.hpp"
#include "expression/tape.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The trace of the field's Jacobian, of all states, as the equations' graph has it.
class Divergence {
 public:
  // With the options of the study.
  explicit Divergence(const Study& study);

  // In inverse time of the model. Nothing where a state or the phase changes it, nor where the
  // equations jump with a state: tangent vectors jump there, too.
  std::optional<double> at(const ModelSetting& setting) const;

 private:
  bool is_constant_ = false;
  Tape tape_;  // of the parameters
};

}  // namespace gearsweep
