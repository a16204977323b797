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

using Nodes = std::vector<NodeId>;

void append(const Nodes& from, Nodes* to) { to->insert(to->end(), from.begin(), from.end()); }

// Works out the tapes of a model, step by step as make_tapes() tells. The formula's graph gains
// what that takes.
class TapeMaker {
 public:
  TapeMaker(const Lowered& lowered, Formula* formula)
      : lowered_(lowered),
        formula_(*formula),
        parameters_(formula->parameters),
        // No name of a user's has a space.
        turn_(formula->turn.value_or(formula->graph.symbol("no turn"))) {
    append(formula->choices, &parameters_);
    moment_ = formula->states;
    for (const Surface& surface : lowered.surfaces) moment_.push_back(surface.side);
    append(lowered.point, &moment_);
    append(lowered.coefs, &moment_);
  }

  void add_checks(const ModelDefinition& definition, Tapes* tapes) {
    Nodes checks = formula_.checks;
    for (std::size_t i = 0; i < formula_.checks.size(); ++i) {
      tapes->messages.push_back(split_message(definition.checks[i].message));
      append(formula_.check_values[i], &checks);
    }
    tapes->checks = of_parameters(checks);
  }

  // What the phase changes.
  void add_coefs(Tapes* tapes) {
    Nodes turned = parameters_;
    turned.push_back(turn_);
    tapes->breaks =
        PhaseBreaks(formula_.graph, turned, formula_.phase, lowered_.coef_values, formula_.names);
    tapes->waves = PhaseWaves(&formula_.graph, parameters_, {formula_.phase, turn_, formula_.cycle},
                              lowered_.coef_values);
    tapes->coefs = coefs_of(lowered_, parameters_, turn_, &formula_);
  }

  void add_setting(Tapes* tapes) {
    tapes->period = of_parameters({formula_.period});
    tapes->cycle = of_parameters({formula_.cycle});
    tapes->start = of_parameters(formula_.start);
    tapes->jumps = of_parameters(formula_.jumps);
    tapes->point = of_parameters(lowered_.point_values);
  }

  void add_field(Tapes* tapes) {
    tapes->rhs = of_moment(lowered_.equations);
    tapes->jacobian = of_moment(lowered_.jacobian);
    tapes->signals = of_moment(lowered_.signals);
  }

  void add_levels(Tapes* tapes) {
    Nodes levels, drifts, held, held_drifts;
    for (const Surface& surface : lowered_.surfaces) {
      tapes->are_staircases.push_back(surface.is_staircase);
      levels.push_back(surface.level);
      drifts.push_back(surface.drift);
      held.push_back(surface.held);
      held_drifts.push_back(surface.held_drift);
    }
    std::map<SurfaceValue, Tape>& of_surfaces = tapes->of_surfaces;
    const Nodes held_gradients = slopes(held);
    of_surfaces[SurfaceValue::level] = of_moment(levels);
    of_surfaces[SurfaceValue::level_gradient] = of_moment(slopes(levels));
    of_surfaces[SurfaceValue::level_drift] = of_moment(drifts);
    of_surfaces[SurfaceValue::held] = of_moment(held);
    of_surfaces[SurfaceValue::held_gradient] = of_moment(held_gradients);
    of_surfaces[SurfaceValue::held_bend] = of_moment(slopes(held_gradients));
    of_surfaces[SurfaceValue::held_drift] = of_moment(held_drifts);
    of_surfaces[SurfaceValue::held_drift_gradient] = of_moment(slopes(held_drifts));
  }

  // Where nothing is reset, all stays what it is.
  void add_resets(Tapes* tapes) {
    const Nodes none(formula_.states.size(), formula_.graph.number(0.0));
    Nodes resets, reset_drifts, turns;
    for (const Surface& surface : lowered_.surfaces) {
      const bool is_reset = !surface.reset.empty();
      append(is_reset ? surface.reset : formula_.states, &resets);
      append(is_reset ? surface.reset_drift : none, &reset_drifts);
      append(is_reset ? surface.turn : none, &turns);
    }
    tapes->of_surfaces[SurfaceValue::reset] = of_moment(resets);
    tapes->of_surfaces[SurfaceValue::reset_gradient] = of_moment(slopes(resets));
    tapes->of_surfaces[SurfaceValue::reset_drift] = of_moment(reset_drifts);
    tapes->of_surfaces[SurfaceValue::turn] = of_moment(turns);
  }

  void add_contacts(Tapes* tapes) {
    Nodes places;
    for (const Contact& contact : lowered_.contacts.list) {
      const Nodes place = {contact.deflection, contact.backlash};
      append(place, &places);
      tapes->contacts.push_back({of_moment(contact.direction), of_moment(slopes(contact.direction)),
                                 of_moment(slopes(place))});
    }
    tapes->contact_places = of_moment(places);
  }

 private:
  Tape of_parameters(const Nodes& nodes) const { return {formula_.graph, parameters_, nodes}; }
  Tape of_moment(const Nodes& nodes) const { return {formula_.graph, moment_, nodes}; }

  // [node][state]
  Nodes slopes(const Nodes& nodes) {
    Nodes out;
    for (const NodeId id : nodes) {
      for (const NodeId state : formula_.states) {
        out.push_back(derivative(&formula_.graph, id, state));
      }
    }
    return out;
  }

  const Lowered& lowered_;
  Formula& formula_;
  Nodes parameters_;  // and choices
  NodeId turn_;
  Nodes moment_;  // states, sides, point, coefs
};

}  // namespace

Tapes make_tapes(const ModelDefinition& definition, const Lowered& lowered, Formula* formula) {
  Tapes tapes;
  tapes.states = formula->states.size();
  tapes.points = lowered.point.size();
  tapes.coef_count = lowered.coefs.size();
  tapes.listed = formula->jumps.size();
  tapes.file = definition.period.file;
  for (const OptionInfo& option : definition.options) {
    if (definition.choices.empty()) tapes.choices.push_back(option.choices.size());
  }
  TapeMaker maker(lowered, formula);
  maker.add_setting(&tapes);
  maker.add_checks(definition, &tapes);
  maker.add_coefs(&tapes);
  maker.add_field(&tapes);
  maker.add_levels(&tapes);
  maker.add_resets(&tapes);
  maker.add_contacts(&tapes);
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
