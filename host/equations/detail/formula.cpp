#include "equations/detail/formula.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "equations/detail/check_message.hpp"
#include "equations/detail/text_reader.hpp"

namespace gearsweep {
namespace {

// What the device and the host have numbers for.
void add_symbols(const ModelDefinition& definition, Formula* formula) {
  ExpressionGraph& graph = formula->graph;
  for (const ChannelInfo& state : definition.states) {
    formula->states.push_back(graph.symbol(state.name));
  }
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    const ParameterInfo& parameter = definition.parameters[i];
    formula->parameters.push_back(graph.symbol(definition.symbols[i].text));
    formula->are_negative.push_back(parameter.min < 0.0);
    formula->are_swept.push_back(definition.swept.contains(parameter.name));
  }
  if (definition.choices.empty()) {
    for (const std::string& name : choice_names(definition.options)) {
      formula->choices.push_back(graph.symbol(name));
    }
  }
  formula->phase = graph.symbol("phase");
  if (definition.cycle) formula->turn = graph.symbol("turn");
}

void read_equations(const ModelDefinition& definition, TextReader* reader, Formula* formula) {
  for (const ExpressionText& text : definition.equations) {
    const bool is_clock =
        definition.second && formula->equations.size() + 1 == definition.equations.size();
    formula->equations.push_back(is_clock ? reader->of_parameters(text, "the second frequency")
                                          : reader->read(text));
  }
  for (const ExpressionText& text : definition.signal_values) {
    formula->signals.push_back(reader->read(text));
  }
}

void read_surfaces(const ModelDefinition& definition, TextReader* reader, Formula* formula) {
  for (const SurfaceDefinition& surface : definition.surfaces) {
    formula->impacts.push_back({surface.name, reader->without_table(surface.when), {}});
    for (const ExpressionText& text : surface.reset) {
      formula->impacts.back().reset.push_back(reader->without_table(text));
    }
  }
  for (const SectionDefinition& section : definition.sections) {
    formula->sections.push_back(
        {reader->without_table(section.value), section.of_rate, section.is_down});
  }
}

void read_starts(const ModelDefinition& definition, TextReader* reader, Formula* formula) {
  for (const ExpressionText& text : definition.start) {
    formula->start.push_back(reader->of_parameters(text, "a start"));
  }
  for (const ExpressionText& text : definition.jumps) {
    formula->jumps.push_back(reader->of_parameters(text, "a phase of a jump"));
  }
}

void read_period(const ModelDefinition& definition, TextReader* reader, Formula* formula) {
  formula->period = reader->of_parameters(definition.period, "the period");
  formula->cycle = formula->graph.number(1.0);
  if (!definition.cycle) return;
  formula->cycle = reader->of_parameters(*definition.cycle, "the cycle");
  formula->period =
      formula->graph.as_written(Operation::multiply, {formula->cycle, formula->period});
}

// As a number that is 1 where it holds.
NodeId read_condition(const ModelCheck& check, TextReader* reader) {
  ExpressionText chosen = check.condition;
  const std::string before = "if(";
  chosen.text = fmt::format("{}{}, 1, 0)", before, chosen.text);
  chosen.column -= std::min(chosen.column, before.size());
  return reader->of_parameters(chosen, "a check");
}

std::vector<NodeId> values_in_message(const ModelCheck& check, TextReader* reader) {
  std::vector<NodeId> values;
  for (const std::string& text : split_message(check.message).values) {
    const ExpressionText value = {text, check.condition.file, check.condition.line, 1};
    values.push_back(reader->of_parameters(value, "a message"));
  }
  return values;
}

}  // namespace

Formula parse_formula(const ModelDefinition& definition) {
  Formula formula;
  add_symbols(definition, &formula);
  TextReader reader(definition, &formula);
  reader.read_definitions();
  read_equations(definition, &reader, &formula);
  read_surfaces(definition, &reader, &formula);
  read_starts(definition, &reader, &formula);
  read_period(definition, &reader, &formula);
  for (const ModelCheck& check : definition.checks) {
    formula.checks.push_back(read_condition(check, &reader));
    formula.check_values.push_back(values_in_message(check, &reader));
  }
  formula.unused = reader.unused();
  formula.constants.assign(reader.constants().begin(), reader.constants().end());
  return formula;
}

void check_presets(const ModelDefinition& definition) {
  for (const PresetInfo& preset : definition.presets) {
    if (preset.expressions.empty()) continue;
    ModelDefinition with_it = definition;
    for (const auto& [name, text] : preset.expressions) with_it.expressions[name] = text;
    parse_formula(with_it);
  }
}

}  // namespace gearsweep
