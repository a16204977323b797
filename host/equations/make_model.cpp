#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "equations/definition.hpp"
#include "equations/detail/derived_values.hpp"
#include "equations/detail/findings.hpp"
#include "equations/detail/kernel_size.hpp"
#include "equations/detail/kernel_writer.hpp"
#include "equations/detail/listed_jumps.hpp"
#include "equations/detail/refusals.hpp"
#include "equations/detail/state_jumps.hpp"
#include "equations/detail/step_work.hpp"
#include "equations/detail/text_point.hpp"
#include "equations/field_graph.hpp"
#include "expression/print.hpp"
#include "model/error.hpp"
#include "model/range_groups.hpp"

namespace gearsweep {
namespace {

std::string check_of(const Tapes& tapes, const DerivedValues& derived,
                     const ModelSetting& setting) {
  const std::vector<double> inputs = inputs_of(tapes, setting);
  const std::string underivable = derived.wrong(inputs);
  if (!underivable.empty()) return underivable;
  const std::vector<double> checks = tapes.checks.run_all(inputs);
  std::size_t value = tapes.messages.size();
  for (std::size_t i = 0; i < tapes.messages.size(); ++i) {
    if (checks[i] != 1.0) return filled(tapes.messages[i], checks.data() + value);
    value += tapes.messages[i].values.size();
  }
  const std::string wrong = wrong_cycle(tapes.cycle.run(inputs));
  if (!wrong.empty()) return wrong;
  const double period = tapes.period.run(inputs);
  if (!std::isfinite(period) || period <= 0.0) {
    return fmt::format("the forcing period is {}; it must be a finite number above 0", period);
  }
  try {
    return tapes.waves.check(inputs, tapes.breaks);
  } catch (const InputError& error) {
    return error.what();
  }
}

void set_lists(const ModelDefinition& definition, const Formula& formula, const Lowered& lowered,
               Model* model) {
  model->name = definition.name;
  model->summary = definition.summary;
  model->assumptions = definition.assumptions;
  model->states = definition.states;
  model->signals = definition.signals;
  model->parameters = definition.parameters;
  model->options = definition.options;
  model->presets = definition.presets;
  model->curves = definition.curves;
  model->drawings = definition.drawings;
  model->unit_drawing = definition.unit_drawing;
  model->constants = definition.constant_infos;
  model->mirror_pairs = definition.mirrors;
  model->cycle_parameters = symbols_in(formula.graph, {formula.cycle}, formula.parameters);
  model->max_step = definition.max_step;
  model->text = definition.text;
  for (std::size_t i = 0; i < model->parameters.size(); ++i) {
    const std::vector<NodeId> parts = parts_of(formula.graph, formula.jumps);
    const bool moves_jump = std::ranges::find(parts, formula.parameters[i]) != parts.end();
    model->parameters[i].shapes_phase = lowered.shapes_phase[i] || moves_jump;
  }
  for (std::size_t i = 0; i < model->states.size(); ++i) {
    if (definition.are_angles[i]) model->angles.push_back(i);
    const auto velocity = std::ranges::find(formula.states, formula.equations[i]);
    if (velocity == formula.states.end()) continue;
    model->states[i].velocity =
        model->states[static_cast<std::size_t>(velocity - formula.states.begin())].name;
  }
  model->range_groups = range_groups_of(definition.groups);
  model->diverged_above = definition.diverged_above;
  for (std::size_t i = 0; i < lowered.coefs.size(); ++i) {
    model->phase_coefs.push_back(
        {fmt::format("w{}", i), "",
         to_short_text(formula.graph, lowered.coef_values[i], formula.names)});
  }
  // As a header without any has (kernels/model_types.h).
  model->is_autonomous = lowered.coefs.empty();
  if (model->is_autonomous) {
    model->phase_coefs.push_back({"one", "", "1: nothing depends on the phase"});
  }
}

// The unit of the first state that a node depends on.
std::string unit_of(const Formula& formula, const ModelDefinition& definition, NodeId id) {
  const std::vector<NodeId> parts = parts_of(formula.graph, {id});
  for (std::size_t i = 0; i < formula.states.size(); ++i) {
    const bool is_in = std::ranges::find(parts, formula.states[i]) != parts.end();
    if (is_in) return definition.states[i].unit;
  }
  return "1";
}

// what: it belongs to.
void refuse_taken(const ModelDefinition& definition, const std::string& name,
                  const std::string& what) {
  const auto is_taken = [&](const auto& infos) {
    return std::ranges::any_of(infos, [&](const auto& info) { return info.name == name; });
  };
  if (!is_taken(definition.states) && !is_taken(definition.signals)) return;
  throw InputError(fmt::format("{}: '{}' is what a signal of {} is called; take another name",
                               definition.period.file, name, what));
}

constexpr const char* kMaxima = "maxima";

// The first surface that resets a state.
std::optional<std::size_t> find_reset(const Formula& formula, std::size_t state) {
  const auto found = std::ranges::find_if(formula.impacts, [&](const Formula::Impact& impact) {
    return impact.reset[state] != formula.states[state];
  });
  if (found == formula.impacts.end()) return std::nullopt;
  return static_cast<std::size_t>(found - formula.impacts.begin());
}

// A motion without a clock is looked at where its first state that moves, and is no angle, is
// largest, where its file and the study say nothing else and Binding::looked_at no other; where a
// surface resets that state, right behind the surface: the state may have no maximum then. Of
// angles alone the sine of the first is looked at, which is largest once in a turn, and once in a
// swing.
void add_own_section(ModelDefinition* definition, Formula* formula) {
  if (!definition->sections.empty() || has_phase(*formula)) return;
  std::optional<std::size_t> state = definition->looked_at;
  for (std::size_t i = 0; i < definition->states.size() && !state; ++i) {
    const bool moves = !formula->graph.is_number(formula->equations[i], 0.0);
    if (!definition->are_angles[i] && (moves || find_reset(*formula, i))) state = i;
  }
  const auto add = [&](const std::string& name, const ExpressionText& text, NodeId value,
                       bool of_rate) {
    definition->sections.push_back({name, text, of_rate, true});
    formula->sections.push_back({value, of_rate, true});
  };
  const auto text_of = [&](const std::string& text) {
    return ExpressionText{text, definition->period.file};
  };
  if (state) {
    const std::string& name = definition->states[*state].name;
    const std::optional<std::size_t> reset = find_reset(*formula, *state);
    if (!reset) return add(kMaxima, text_of(name), formula->states[*state], true);
    const SurfaceDefinition& surface = definition->surfaces[*reset];
    return add(surface.name, surface.when, formula->impacts[*reset].when, false);
  }
  const auto angle = std::ranges::find(definition->are_angles, true);
  if (angle == definition->are_angles.end()) return;
  const auto first = static_cast<std::size_t>(angle - definition->are_angles.begin());
  add(kMaxima, text_of(fmt::format("sin({})", definition->states[first].name)),
      formula->graph.make(Operation::sine, {formula->states[first]}), true);
}

// The sections, whose signals are lowered, and get their names here.
std::vector<SectionInfo> add_section_signals(const Formula& formula, ModelDefinition* definition) {
  std::vector<SectionInfo> sections;
  for (std::size_t i = 0; i < formula.sections.size(); ++i) {
    const std::string& name = definition->sections[i].name;
    const auto is_same = [&](const SectionInfo& section) { return section.name == name; };
    if (std::ranges::any_of(sections, is_same)) {
      throw InputError(fmt::format("{}: there are two sections '{}'",
                                   definition->sections[i].value.place(), name));
    }
    const std::string unit = definition->sections[i].of_rate
                                 ? "1"
                                 : unit_of(formula, *definition, formula.sections[i].value);
    const auto add = [&](const std::string& suffix, const std::string& signal_unit,
                         const std::string& meaning) {
      refuse_taken(*definition, name + suffix, fmt::format("section '{}'", name));
      ChannelInfo info{name + suffix, signal_unit, meaning};
      info.is_hidden = true;
      definition->signals.push_back(std::move(info));
      return definition->signals.size() - 1;
    };
    const std::size_t level = add("_level", unit, "what rises through 0 at the section");
    const std::size_t rate = add("_rate", "1", "rate of that");
    const std::size_t size = add("_size", unit, "what its terms come to without their signs");
    sections.push_back({name, place_of(definition->sections[i]), level, rate, size});
  }
  return sections;
}

// The contacts, with the signals that what looks at them needs.
std::vector<ContactInfo> add_contact_signals(const Formula& formula, ModelDefinition* definition,
                                             Lowered* lowered) {
  std::vector<ContactInfo> contacts;
  for (const Contact& contact : lowered->contacts.list) {
    if (contact.is_hidden) break;
    const std::string before = contact.name.empty() ? "" : contact.name + "_";
    const std::string unit = unit_of(formula, *definition, contact.deflection);
    const auto add = [&](const std::string& name, const std::string& meaning, NodeId id) {
      refuse_taken(*definition, before + name, "one of the model's contacts");
      definition->signals.push_back({before + name, unit, meaning});
      lowered->signals.push_back(id);
      return lowered->signals.size() - 1;
    };
    const bool is_stop = contact.is_one_sided;
    const std::size_t deflection =
        add("deflection", is_stop ? "what meets the stop" : "what the backlash is taken from",
            contact.deflection);
    const std::size_t backlash =
        add("backlash", is_stop ? "where the stop is" : "half of the backlash", contact.backlash);
    contacts.push_back({contact.name, deflection, backlash, is_stop});
  }
  return contacts;
}

// The signals of contacts are lowered ones: back to what these are made of.
std::shared_ptr<const FieldGraph> field_graph_of(Formula formula, const Lowered& lowered) {
  auto field = std::make_shared<FieldGraph>(FieldGraph{std::move(formula.graph), formula.states,
                                                       formula.parameters, formula.choices,
                                                       formula.equations, formula.signals});
  std::map<NodeId, NodeId> values;
  for (std::size_t i = 0; i < lowered.point.size(); ++i) {
    values[lowered.point[i]] = lowered.point_values[i];
  }
  for (std::size_t i = 0; i < lowered.coefs.size(); ++i) {
    values[lowered.coefs[i]] = lowered.coef_values[i];
  }
  Rewriter raised(&field->graph, std::move(values));
  for (std::size_t i = formula.signals.size(); i < lowered.signals.size(); ++i) {
    field->signals.push_back(raised(lowered.signals[i]));
  }
  return field;
}

ModelDefinition bound(ModelDefinition definition, const Binding& binding) {
  for (const auto& [name, curve] : binding.curves) {
    const bool is_known = std::ranges::find(definition.curves, name) != definition.curves.end();
    if (!is_known) throw std::out_of_range("no curve '" + name + "'");
  }
  definition.given_curves = binding.curves;
  definition.choices = binding.options;
  definition.swept = binding.parameters;
  definition.expressions = binding.expressions;
  if (definition.clock) {
    definition.clock = binding.clock;
    definition.period.text = fmt::format("{}", binding.clock);
  }
  definition.looked_at = binding.looked_at;
  return definition;
}

// What derived parameters come to at the other ones' defaults is theirs.
void set_derived(const std::shared_ptr<const Tapes>& tapes,
                 const std::shared_ptr<const DerivedValues>& derived, Model* model) {
  model->derived = derived->list();
  if (model->derived.empty()) return;
  model->derive = [tapes, derived](ModelSetting* setting) {
    derived->put(inputs_of(*tapes, *setting), setting);
  };
  ModelSetting setting = model->default_setting();
  model->derive(&setting);
  for (const DerivedParameter& one : model->derived) {
    model->parameters[one.parameter].default_value = setting.parameters[one.parameter];
  }
}

}  // namespace

Model make_model(const ModelDefinition& given) {
  ModelDefinition definition = given;
  Formula formula = parse_formula(definition);
  refuse_phase_without_clock(definition, formula);
  add_own_section(&definition, &formula);
  refuse_unrolled_angles(definition, &formula);
  refuse_unreached_places(definition, &formula);
  if (definition.expressions.empty() || definition.mirrors.empty()) {
    refuse_unmirrored_starts(definition, &formula);
  } else {
    ModelDefinition underived = definition;
    underived.expressions.clear();
    Formula without = parse_formula(underived);
    refuse_unmirrored_starts(underived, &without);
  }
  // Kept of a model whose options are not chosen yet.
  const auto written = formula.choices.empty() ? nullptr : std::make_shared<const Formula>(formula);
  Lowered lowered = lower(&formula);
  const std::vector<SectionInfo> sections = add_section_signals(formula, &definition);
  const std::vector<ContactInfo> contacts = add_contact_signals(formula, &definition, &lowered);
  const auto tapes = std::make_shared<const Tapes>(make_tapes(definition, lowered, &formula));
  const auto derived = std::make_shared<const DerivedValues>(definition, formula);
  Model model;
  set_lists(definition, formula, lowered, &model);
  set_derived(tapes, derived, &model);
  model.contacts = contacts;
  model.sections = sections;
  if (given.sections.empty() && sections.size() == 1) {
    model.sections.front().is_own = sections.front().name == kMaxima;
  }
  model.corners = lowered.contacts.list.size() - contacts.size();
  for (const RoughPlace& place : lowered.uncorrected) {
    model.uncorrected.push_back(
        fmt::format("{} (in {})", place.expression, equation_of(definition, place)));
  }
  for (const Surface& surface : lowered.surfaces) {
    SurfaceInfo info{surface.name, "", "", surface.is_staircase, !surface.reset.empty()};
    if (!info.resets) {
      const StateJump jump = state_jumps_of(definition, {surface.place}).front();
      info.expression = jump.expression;
      info.place = jump.place;
    }
    model.surfaces.push_back(info);
  }
  model.state_jumps = state_jumps_by_setting(definition, written, lowered);
  model.findings = findings_of(definition, formula, lowered, tapes->breaks);
  model.phase_findings = phase_findings_of(definition, formula, lowered, tapes->breaks);
  model.is_rough = !tapes->breaks.tables_left_out().empty();
  model.unused = formula.unused;
  const TangentProgram tangent = tangent_program(&formula, lowered);
  model.kernel = kernel_of(definition, &formula, lowered, tangent, model.is_rough);
  model.work = step_work_of(formula, lowered, tangent);
  refuse_large_kernel(definition, formula, lowered, model.kernel);
  model.field = field_graph_of(std::move(formula), lowered);
  model.check = [tapes, derived](const ModelSetting& setting) {
    return check_of(*tapes, *derived, setting);
  };
  model.notices = [tapes](const ModelSetting& setting) { return broken_promises(*tapes, setting); };
  model.break_phases = [tapes](const ModelSetting& setting) {
    return break_phases_of(*tapes, setting);
  };
  model.phase_table = [tapes](const ModelSetting& setting, std::span<const PhasePlace> places,
                              double* rows) { write_phase_table(*tapes, setting, places, rows); };
  model.phase_rows = [tapes](const ModelSetting& setting) -> Model::PhaseRow {
    return [coefs = CoefsAt(*tapes, setting)](double psi, double inside, double* row) mutable {
      coefs(psi, inside, row);
    };
  };
  model.equilibrium = [tapes](const ModelSetting& setting) {
    std::vector<double> x(tapes->states);
    tapes->start.run(inputs_of(*tapes, setting).data(), x.data());
    return x;
  };
  model.prepare = [tapes](const ModelSetting& setting) -> std::unique_ptr<PreparedPoint> {
    return std::make_unique<TextPoint>(tapes, setting);
  };
  model.period = [tapes](const ModelSetting& setting) {
    return tapes->period.run(inputs_of(*tapes, setting));
  };
  if (given.cycle) {
    model.cycle = [tapes](const ModelSetting& setting) {
      return tapes->cycle.run(inputs_of(*tapes, setting));
    };
  }
  model.is_clockless = given.clock.has_value();
  model.clocks = given.second ? 1 : 0;
  model.binding = {given.given_curves, given.choices, given.swept, given.expressions};
  if (given.clock) model.binding.clock = *given.clock;
  model.binding.looked_at = given.looked_at;
  model.bound = [defined = std::make_shared<const ModelDefinition>(given)](const Binding& binding) {
    return make_model(bound(*defined, binding));
  };
  return model;
}

}  // namespace gearsweep
