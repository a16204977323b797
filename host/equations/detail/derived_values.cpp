#include "equations/detail/derived_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "equations/field_graph.hpp"

namespace gearsweep {

DerivedValues::DerivedValues(const ModelDefinition& definition, const Formula& formula) {
  std::vector<NodeId> values;
  for (const auto& [parameter, value] : formula.derived) {
    const ParameterInfo& info = definition.parameters[parameter];
    const ExpressionText& text = definition.expressions.at(info.name);
    list_.push_back({parameter, text.text, text.place(),
                     symbols_in(formula.graph, {value}, formula.parameters)});
    infos_.push_back(info);
    values.push_back(value);
  }
  std::vector<NodeId> inputs = formula.parameters;
  inputs.insert(inputs.end(), formula.choices.begin(), formula.choices.end());
  tape_ = Tape(formula.graph, inputs, values);
}

void DerivedValues::put(const std::vector<double>& inputs, ModelSetting* setting) const {
  const std::vector<double> values = tape_.run_all(inputs);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    setting->parameters[list_[i].parameter] = values[i];
  }
}

std::string DerivedValues::wrong(const std::vector<double>& inputs) const {
  if (list_.empty()) return "";
  const std::vector<double> values = tape_.run_all(inputs);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const ParameterInfo& info = infos_[i];
    const std::string told = fmt::format("{}: {} = {} comes to {}", list_[i].place, info.name,
                                         list_[i].expression, values[i]);
    if (!std::isfinite(values[i])) return told + ", which is no finite number";
    if (values[i] >= info.min && values[i] <= info.max) continue;
    return fmt::format("{}, out of range; from {} to {} is allowed", told, info.min, info.max);
  }
  return "";
}

}  // namespace gearsweep
