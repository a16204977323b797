// What a model's rates may be anywhere in a box of states, by interval arithmetic on its equations:
// a pulse or a switch that is narrower than a step lies between the moments at which the step
// looks.
#pragma once

#include <vector>

#include "equations/field_graph.hpp"
#include "expression/interval.hpp"

namespace gearsweep {

class FieldReach {
 public:
  // For a model whose rates do not depend on the phase.
  FieldReach(const Model& model, const ModelSetting& setting);

  // [state]: how far the rate may range in the box, at most; infinity where nothing can be said.
  std::vector<double> rate_ranges(const std::vector<double>& low, const std::vector<double>& high);

 private:
  Interval value_of(const Node& node) const;

  FieldGraph field_;
  std::vector<NodeId> parts_;      // that the rates are made of, arguments first
  std::vector<Enclosure> values_;  // [node]; slopes are not used
};

}  // namespace gearsweep
