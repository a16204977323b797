// What derived parameters come to at a setting.
#pragma once

#include <string>
#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/formula.hpp"
#include "expression/tape.hpp"
#include "model/model.hpp"

namespace gearsweep {

class DerivedValues {
 public:
  DerivedValues(const ModelDefinition& definition, const Formula& formula);

  const std::vector<DerivedParameter>& list() const { return list_; }
  // inputs: as inputs_of() has them; what stands there for derived parameters is not looked at.
  void put(const std::vector<double>& inputs, ModelSetting* setting) const;
  // The first of them that is not finite or out of its range, with its place; empty if none is.
  std::string wrong(const std::vector<double>& inputs) const;

 private:
  std::vector<DerivedParameter> list_;
  std::vector<ParameterInfo> infos_;  // of the same
  Tape tape_;
};

}  // namespace gearsweep
