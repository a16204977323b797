#include "plan/divergence.hpp"

#include <algorithm>
#include <vector>

#include "expression/differentiate.hpp"

namespace gearsweep {

Divergence::Divergence(const Study& study) {
  FieldGraph field = field_of(*study.model, study.setting.options);
  NodeId sum = field.graph.number(0.0);
  for (std::size_t i = 0; i < field.states.size(); ++i) {
    const NodeId part = derivative(&field.graph, field.rates[i], field.states[i]);
    sum = field.graph.make(Operation::add, {sum, part});
  }
  is_constant_ = std::ranges::all_of(parts_of(field.graph, {sum}), [&](NodeId id) {
    return field.graph[id].operation != Operation::symbol ||
           std::ranges::find(field.parameters, id) != field.parameters.end();
  });
  // A jump stretches and squeezes beside the field.
  is_constant_ = is_constant_ && study.model->surfaces.empty();
  if (is_constant_) tape_ = Tape(field.graph, field.parameters, {sum});
}

std::optional<double> Divergence::at(const ModelSetting& setting) const {
  if (!is_constant_) return std::nullopt;
  return tape_.run(setting.parameters);
}

}  // namespace gearsweep
