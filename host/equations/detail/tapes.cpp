#include "equations/detail/tapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "equations/definition.hpp"
#include "equations/detail/one_sided.hpp"
#include "expression/differentiate.hpp"
#include "model/error.hpp"

namespace gearsweep {

namespace {

// Turn, a phase inside and the phase.
std::array<double, 3> phases_of(double cycle, double psi, double inside) {
  const double turn = std::floor(cycle * inside);
  return {turn, kWholePhase * (cycle * inside - turn), kWholePhase * (cycle * psi - turn)};
}

TapeOfStudy coefs_of(const Lowered& lowered, const std::vector<NodeId>& parameters, NodeId turn,
                     Formula* formula) {
  const NodeId inside = formula->graph.symbol("phase inside");
  std::vector<NodeId> inputs;
  std::vector<std::size_t> common, own;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool differs = i < formula->parameters.size() && formula->are_swept[i];
    if (!differs) common.push_back(i);
    if (differs && lowered.shapes_phase[i]) own.push_back(i);
  }
  for (const std::size_t i : common) inputs.push_back(parameters[i]);
  for (const std::size_t i : own) inputs.push_back(parameters[i]);
  inputs.insert(inputs.end(), {turn, inside, formula->phase});
  const std::vector<NodeId> coefs =
      one_sided(&formula->graph, formula->phase, inside, lowered.coef_values);
  return {Tape(formula->graph, inputs, coefs), std::move(common), std::move(own)};
}

}  // namespace

Tapes make_tapes(const ModelDefinition& definition, const Lowered& lowered, Formula* formula) {
  const ExpressionGraph& graph = formula->graph;
  std::vector<NodeId> parameters = formula->parameters;
  parameters.insert(parameters.end(), formula->choices.begin(), formula->choices.end());
  Tapes tapes;
  tapes.states = formula->states.size();
  tapes.points = lowered.point.size();
  tapes.coef_count = lowered.coefs.size();
  tapes.listed = formula->jumps.size();
  tapes.file = definition.period.file;
  for (const OptionInfo& option : definition.options) {
    if (definition.choices.empty()) tapes.choices.push_back(option.choices.size());
  }
  std::vector<NodeId> checks = formula->checks;
  for (std::size_t i = 0; i < formula->checks.size(); ++i) {
    tapes.messages.push_back(split_message(definition.checks[i].message));
    const std::vector<NodeId>& values = formula->check_values[i];
    checks.insert(checks.end(), values.begin(), values.end());
  }
  // No name of a user's has a space.
  const NodeId turn = formula->turn.value_or(formula->graph.symbol("no turn"));
  std::vector<NodeId> turned = parameters;
  turned.push_back(turn);
  tapes.breaks = PhaseBreaks(graph, turned, formula->phase, lowered.coef_values, formula->names);
  tapes.waves = PhaseWaves(&formula->graph, parameters, {formula->phase, turn, formula->cycle},
                           lowered.coef_values);
  std::vector<NodeId> moment = formula->states;
  for (const Surface& surface : lowered.surfaces) {
    moment.push_back(surface.side);
    tapes.are_staircases.push_back(surface.is_staircase);
  }
  moment.insert(moment.end(), lowered.point.begin(), lowered.point.end());
  moment.insert(moment.end(), lowered.coefs.begin(), lowered.coefs.end());
  tapes.period = Tape(graph, parameters, {formula->period});
  tapes.cycle = Tape(graph, parameters, {formula->cycle});
  tapes.checks = Tape(graph, parameters, checks);
  tapes.start = Tape(graph, parameters, formula->start);
  tapes.jumps = Tape(graph, parameters, formula->jumps);
  tapes.coefs = coefs_of(lowered, parameters, turn, formula);
  tapes.point = Tape(graph, parameters, lowered.point_values);
  tapes.rhs = Tape(graph, moment, lowered.equations);
  tapes.jacobian = Tape(graph, moment, lowered.jacobian);
  tapes.signals = Tape(graph, moment, lowered.signals);
  const auto slopes = [&](const std::vector<NodeId>& of, const std::vector<NodeId>& by) {
    std::vector<NodeId> out;
    for (const NodeId id : of) {
      for (const NodeId symbol : by) out.push_back(derivative(&formula->graph, id, symbol));
    }
    return out;
  };
  std::vector<NodeId> levels, drifts, held, held_drifts, resets, reset_drifts, turns;
  for (const Surface& surface : lowered.surfaces) {
    levels.push_back(surface.level);
    drifts.push_back(surface.drift);
    held.push_back(surface.held);
    held_drifts.push_back(surface.held_drift);
    // Where nothing is reset, all stays what it is.
    const std::vector<NodeId> none(formula->states.size(), formula->graph.number(0.0));
    const bool is_reset = !surface.reset.empty();
    const auto add = [](const std::vector<NodeId>& from, std::vector<NodeId>* to) {
      to->insert(to->end(), from.begin(), from.end());
    };
    add(is_reset ? surface.reset : formula->states, &resets);
    add(is_reset ? surface.reset_drift : none, &reset_drifts);
    add(is_reset ? surface.turn : none, &turns);
  }
  const auto of_surfaces = [&](SurfaceValue value, const std::vector<NodeId>& nodes) {
    tapes.of_surfaces[value] = Tape(graph, moment, nodes);
  };
  const std::vector<NodeId> held_gradients = slopes(held, formula->states);
  of_surfaces(SurfaceValue::level, levels);
  of_surfaces(SurfaceValue::level_gradient, slopes(levels, formula->states));
  of_surfaces(SurfaceValue::level_drift, drifts);
  of_surfaces(SurfaceValue::held, held);
  of_surfaces(SurfaceValue::held_gradient, held_gradients);
  of_surfaces(SurfaceValue::held_bend, slopes(held_gradients, formula->states));
  of_surfaces(SurfaceValue::held_drift, held_drifts);
  of_surfaces(SurfaceValue::held_drift_gradient, slopes(held_drifts, formula->states));
  of_surfaces(SurfaceValue::reset, resets);
  of_surfaces(SurfaceValue::reset_gradient, slopes(resets, formula->states));
  of_surfaces(SurfaceValue::reset_drift, reset_drifts);
  of_surfaces(SurfaceValue::turn, turns);
  std::vector<NodeId> places;
  for (const Contact& contact : lowered.contacts.list) {
    places.push_back(contact.deflection);
    places.push_back(contact.backlash);
    const auto by_states = [&](const std::vector<NodeId>& of) {
      return Tape(graph, moment, slopes(of, formula->states));
    };
    tapes.contacts.push_back({Tape(graph, moment, contact.direction), by_states(contact.direction),
                              by_states({contact.deflection, contact.backlash})});
  }
  tapes.contact_places = Tape(graph, moment, places);
  return tapes;
}

std::vector<double> inputs_of(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> inputs = setting.parameters;
  for (std::size_t i = 0; i < tapes.choices.size(); ++i) {
    for (std::size_t choice = 0; choice < tapes.choices[i]; ++choice) {
      inputs.push_back(setting.options[i] == static_cast<int>(choice) ? 1.0 : 0.0);
    }
  }
  return inputs;
}

std::string wrong_cycle(double cycle) {
  constexpr double kMaxCycle = 1e6;
  if (cycle >= 1.0 && cycle <= kMaxCycle && cycle == std::floor(cycle)) return "";
  return fmt::format("the cycle is {}; it must be a whole number from 1 to {:.0g}", cycle,
                     kMaxCycle);
}

std::size_t turns_of(const Tapes& tapes, const ModelSetting& setting) {
  const double cycle = tapes.cycle.run(inputs_of(tapes, setting));
  const std::string wrong = wrong_cycle(cycle);
  if (!wrong.empty()) throw InputError(fmt::format("{}: {}", tapes.file, wrong));
  return static_cast<std::size_t>(cycle);
}

void write_phase_table(const Tapes& tapes, const ModelSetting& setting,
                       std::span<const PhasePlace> places, double* rows) {
  if (tapes.coef_count == 0) {  // as Model::phase_coefs has it
    std::fill_n(rows, places.size(), 1.0);
    return;
  }
  const std::vector<double> inputs = inputs_of(tapes, setting);
  const double cycle = tapes.cycle.run(inputs);
  const std::size_t count = places.size();
  std::vector<double> phases(3 * count), columns(tapes.coef_count * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 3> here = phases_of(cycle, places[i].psi, places[i].inside);
    for (std::size_t k = 0; k < here.size(); ++k) phases[k * count + i] = here[k];
  }
  tapes.coefs.given(inputs).run_many(count, phases.data(), columns.data());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < tapes.coef_count; ++k) *rows++ = columns[k * count + i];
  }
}

CoefsAt::CoefsAt(const Tapes& tapes, const ModelSetting& setting)
    : cycle_(tapes.cycle.run(inputs_of(tapes, setting))),
      coefs_(tapes.coefs.given(inputs_of(tapes, setting))) {}

void CoefsAt::operator()(double psi, double inside, double* row) {
  row[0] = 1.0;
  const auto [turn, phase_inside, phase] = phases_of(cycle_, psi, inside);
  if (inside != inside_) {
    inside_ = inside;
    in_segment_.reset();
    coefs_.run(std::array{turn, phase_inside, phase}.data(), row);
    return;
  }
  // A second phase of the segment: more will follow.
  if (!in_segment_) in_segment_ = coefs_.given({turn, phase_inside});
  in_segment_->run(&phase, row);
}

}  // namespace gearsweep
