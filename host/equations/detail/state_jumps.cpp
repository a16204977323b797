#include "equations/detail/state_jumps.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "equations/detail/corners.hpp"

namespace gearsweep {
namespace {

// The jumps of equations with these options that steps are not cut at.
std::vector<RoughPlace> jumps_with(const ModelSetting& setting, const ModelDefinition& definition,
                                   Formula formula) {
  std::map<NodeId, NodeId> choices;
  std::size_t choice = 0;
  for (std::size_t i = 0; i < definition.options.size(); ++i) {
    for (std::size_t j = 0; j < definition.options[i].choices.size(); ++j) {
      const bool is_made = setting.options[i] == static_cast<int>(j);
      choices[formula.choices[choice++]] = formula.graph.number(is_made ? 1.0 : 0.0);
    }
  }
  Rewriter with_choices(&formula.graph, std::move(choices));
  std::vector<NodeId> equations;
  for (const NodeId id : formula.equations) equations.push_back(with_choices(id));
  return find_corners(&formula, equations).unlocated;
}

}  // namespace

std::string equation_of(const ModelDefinition& definition, const RoughPlace& place) {
  const ExpressionText& text = definition.equations[place.equation];
  return fmt::format("the equation of {}, {}:{}", definition.states[place.equation].name, text.file,
                     text.line);
}

std::vector<StateJump> state_jumps_of(const ModelDefinition& definition,
                                      const std::vector<RoughPlace>& places) {
  std::vector<StateJump> jumps;
  for (const RoughPlace& place : places) {
    jumps.push_back({place.expression, equation_of(definition, place)});
  }
  return jumps;
}

std::function<std::vector<StateJump>(const ModelSetting&)> state_jumps_by_setting(
    const ModelDefinition& definition, const std::shared_ptr<const Formula>& written,
    const Lowered& lowered) {
  std::vector<StateJump> all = state_jumps_of(definition, lowered.jumps);
  // No option changes these: there are none, or nothing jumps whatever they are.
  if (all.empty() || written == nullptr) {
    return [all = std::move(all)](const ModelSetting&) { return all; };
  }
  const auto defined = std::make_shared<const ModelDefinition>(definition);
  return [defined, written](const ModelSetting& setting) {
    return state_jumps_of(*defined, jumps_with(setting, *defined, *written));
  };
}

}  // namespace gearsweep
