#include "equations/detail/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "equations/detail/borders.hpp"
#include "equations/detail/corners.hpp"
#include "equations/detail/phase_breaks.hpp"
#include "expression/differentiate.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// Nothing comes to a place whose level no state changes, or whose level jumps. what: "surface
// 'wall'".
void refuse_unreached(const ExpressionText& text, const std::string& what, NodeId level,
                      Formula* formula) {
  if (may_jump(*formula, {level})) {
    throw InputError(fmt::format(
        "{}: {} may jump with a state: where it lies may not compare, nor have sign, step or "
        "floor; a wall on either side is abs(x) - gap",
        text.place(), what));
  }
  const bool stays = std::ranges::all_of(formula->states, [&](NodeId state) {
    return formula->graph.is_number(derivative(&formula->graph, level, state), 0.0);
  });
  if (!stays) return;
  throw InputError(
      fmt::format("{}: {} lies nowhere: its expression must change with a state, as x - gap does",
                  text.place(), what));
}

// -id, with the sign as far inside as it goes.
NodeId negated(ExpressionGraph* graph, NodeId id) {
  const Operation operation = (*graph)[id].operation;
  std::vector<NodeId> arguments = (*graph)[id].arguments;
  switch (operation) {
    case Operation::negate:
      return arguments[0];
    case Operation::add:
    case Operation::subtract:
      for (NodeId& argument : arguments) argument = negated(graph, argument);
      break;
    case Operation::multiply:
    case Operation::divide:
      arguments[0] = negated(graph, arguments[0]);
      break;
    default:
      return graph->make(Operation::negate, {id});
  }
  return graph->make(operation, arguments);
}

// False where it cannot be told.
bool is_minus(ExpressionGraph* graph, NodeId a, NodeId b) {
  return graph->is_number(graph->make(Operation::add, {a, b}), 0.0) || a == negated(graph, b);
}

}  // namespace

void refuse_unrolled_angles(const ModelDefinition& definition, Formula* formula) {
  const auto refuse = [&](NodeId id, const ExpressionText& text, const std::string& what) {
    for (std::size_t i = 0; i < definition.states.size(); ++i) {
      if (!definition.are_angles[i]) continue;
      if (is_taken_in_turns(&formula->graph, {id}, formula->states[i], kWholePhase)) continue;
      const std::string& name = definition.states[i].name;
      const bool is_clock = definition.second && i + 1 == definition.states.size();
      throw InputError(fmt::format(
          "{}:{}: '{}' is an angle, which is counted within one turn, and {} tells its turns "
          "apart: "
          "an angle may stand in sin, cos and tan alone, with whole numbers as factors, as in "
          "sin(2*{} - phase); {}",
          text.file, text.line, name, what, name,
          is_clock ? "for a part of a turn, make 'second' so much slower"
                   : "leave out 'angle = true'"));
    }
  };
  for (std::size_t row = 0; row < formula->equations.size(); ++row) {
    refuse(formula->equations[row], definition.equations[row],
           fmt::format("the equation of {}", definition.states[row].name));
  }
  for (std::size_t i = 0; i < formula->impacts.size(); ++i) {
    refuse(formula->impacts[i].when, definition.surfaces[i].when,
           fmt::format("surface '{}'", definition.surfaces[i].name));
  }
  for (std::size_t i = 0; i < formula->sections.size(); ++i) {
    refuse(formula->sections[i].value, definition.sections[i].value,
           fmt::format("section '{}'", definition.sections[i].name));
  }
}

void refuse_unreached_places(const ModelDefinition& definition, Formula* formula) {
  for (std::size_t i = 0; i < formula->impacts.size(); ++i) {
    const SurfaceDefinition& surface = definition.surfaces[i];
    refuse_unreached(surface.when, fmt::format("surface '{}'", surface.name),
                     formula->impacts[i].when, formula);
  }
  for (std::size_t i = 0; i < formula->sections.size(); ++i) {
    const SectionDefinition& section = definition.sections[i];
    refuse_unreached(section.value, fmt::format("section '{}'", section.name),
                     formula->sections[i].value, formula);
  }
}

void refuse_unmirrored_starts(const ModelDefinition& definition, Formula* formula) {
  for (const MirrorPairs& mirrors : definition.mirrors) {
    std::map<NodeId, NodeId> alike;
    for (const auto& [first, second] : mirrors.parameters) {
      alike[formula->parameters[second]] = formula->parameters[first];
    }
    Rewriter rewrite(&formula->graph, alike);
    for (const auto& [first, second] : mirrors.states) {
      const NodeId from = rewrite(formula->start[first]), to = rewrite(formula->start[second]);
      if (is_minus(&formula->graph, from, to)) continue;
      throw InputError(fmt::format(
          "{}: '{}' and '{}' are said to mirror each other, and their starts are not shown to: one "
          "must be minus the other where the parameters of the mirror are equal",
          definition.period.file, definition.states[first].name, definition.states[second].name));
    }
  }
}

bool has_phase(const Formula& formula) {
  std::vector<NodeId> all = formula.equations;
  all.insert(all.end(), formula.signals.begin(), formula.signals.end());
  for (const Formula::Impact& impact : formula.impacts) {
    all.push_back(impact.when);
    all.insert(all.end(), impact.reset.begin(), impact.reset.end());
  }
  for (const Formula::Section& section : formula.sections) all.push_back(section.value);
  const std::vector<NodeId> parts = parts_of(formula.graph, all);
  return std::ranges::find(parts, formula.phase) != parts.end();
}

void refuse_phase_without_clock(const ModelDefinition& definition, const Formula& formula) {
  if (!definition.clock || !has_phase(formula)) return;
  throw InputError(
      fmt::format("{}: there is a phase in it, so the model needs its period:\n"
                  "  [forcing]\n  period = \"2*pi/omega\"",
                  definition.period.file));
}

}  // namespace gearsweep
