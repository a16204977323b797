#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "equations/definition.hpp"
#include "equations/detail/added_signals.hpp"
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

void refuse_what_cannot_be(const ModelDefinition& definition, Formula* formula) {
  refuse_unrolled_angles(definition, formula);
  refuse_unreached_places(definition, formula);
  if (definition.expressions.empty() || definition.mirrors.empty()) {
    return refuse_unmirrored_starts(definition, formula);
  }
  ModelDefinition underived = definition;
  underived.expressions.clear();
  Formula without = parse_formula(underived);
  refuse_unmirrored_starts(underived, &without);
}

// Where the field bends or jumps.
void set_places(const ModelDefinition& definition, const Lowered& lowered, Model* model) {
  model->corners = lowered.contacts.list.size() - model->contacts.size();
  for (const RoughPlace& place : lowered.uncorrected) {
    model->uncorrected.push_back(
        fmt::format("{} (in {})", place.expression, equation_of(definition, place)));
  }
  for (const Surface& surface : lowered.surfaces) {
    SurfaceInfo info{surface.name, "", "", surface.is_staircase, !surface.reset.empty()};
    if (!info.resets) {
      const StateJump jump = state_jumps_of(definition, {surface.place}).front();
      info.expression = jump.expression;
      info.place = jump.place;
    }
    model->surfaces.push_back(info);
  }
}

// What is worked out in double for a setting.
void set_functions(const std::shared_ptr<const Tapes>& tapes,
                   const std::shared_ptr<const DerivedValues>& derived, Model* model) {
  model->check = [tapes, derived](const ModelSetting& setting) {
    return check_of(*tapes, *derived, setting);
  };
  model->notices = [tapes](const ModelSetting& setting) {
    return broken_promises(*tapes, setting);
  };
  model->break_phases = [tapes](const ModelSetting& setting) {
    return break_phases_of(*tapes, setting);
  };
  model->phase_table = [tapes](const ModelSetting& setting, std::span<const PhasePlace> places,
                               double* rows) { write_phase_table(*tapes, setting, places, rows); };
  model->phase_rows = [tapes](const ModelSetting& setting) -> Model::PhaseRow {
    return [coefs = CoefsAt(*tapes, setting)](double psi, double inside, double* row) mutable {
      coefs(psi, inside, row);
    };
  };
  model->equilibrium = [tapes](const ModelSetting& setting) {
    return tapes->start.run_all(inputs_of(*tapes, setting));
  };
  model->prepare = [tapes](const ModelSetting& setting) -> std::unique_ptr<PreparedPoint> {
    return std::make_unique<TextPoint>(tapes, setting);
  };
  model->period = [tapes](const ModelSetting& setting) {
    return tapes->period.run(inputs_of(*tapes, setting));
  };
}

// What a study has bound to the model, and how it binds something else.
void set_binding(const ModelDefinition& given, Model* model) {
  model->is_clockless = given.clock.has_value();
  model->clocks = given.second ? 1 : 0;
  model->binding = {given.given_curves, given.choices, given.swept, given.expressions};
  if (given.clock) model->binding.clock = *given.clock;
  model->binding.looked_at = given.looked_at;
  model->bound = [defined = std::make_shared<const ModelDefinition>(given)](
                     const Binding& binding) { return make_model(bound(*defined, binding)); };
}

}  // namespace

Model make_model(const ModelDefinition& given) {
  // 1. Read the texts.
  ModelDefinition definition = given;
  Formula formula = parse_formula(definition);
  refuse_phase_without_clock(definition, formula);
  const bool sees_maxima = add_own_section(&definition, &formula);
  refuse_what_cannot_be(definition, &formula);
  // Kept of a model whose options are not chosen yet.
  const auto written = formula.choices.empty() ? nullptr : std::make_shared<const Formula>(formula);

  // 2. Cut the formula into what points, the phase and the inner loop work out.
  Model model;
  Lowered lowered = lower(&formula);
  model.sections = add_section_signals(formula, &definition);
  if (sees_maxima) model.sections.front().is_own = true;
  model.contacts = add_contact_signals(formula, &definition, &lowered);
  const auto tapes = std::make_shared<const Tapes>(make_tapes(definition, lowered, &formula));
  const auto derived = std::make_shared<const DerivedValues>(definition, formula);

  // 3. Say what the model has.
  set_lists(definition, formula, lowered, &model);
  set_derived(tapes, derived, &model);
  set_places(definition, lowered, &model);
  model.state_jumps = state_jumps_by_setting(definition, written, lowered);
  model.findings = findings_of(definition, formula, lowered, tapes->breaks);
  model.phase_findings = phase_findings_of(definition, formula, lowered, tapes->breaks);
  model.is_rough = !tapes->breaks.tables_left_out().empty();
  model.unused = formula.unused;

  // 4. Write its kernel.
  const TangentProgram tangent = tangent_program(&formula, lowered);
  model.kernel = kernel_of(definition, &formula, lowered, tangent, model.is_rough);
  model.work = step_work_of(formula, lowered, tangent);
  refuse_large_kernel(definition, formula, lowered, model.kernel);

  // 5. Keep what the host works out with it.
  model.field = field_graph_of(std::move(formula), lowered);
  set_functions(tapes, derived, &model);
  if (given.cycle) {
    model.cycle = [tapes](const ModelSetting& setting) {
      return tapes->cycle.run(inputs_of(*tapes, setting));
    };
  }
  set_binding(given, &model);
  return model;
}

}  // namespace gearsweep
