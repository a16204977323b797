#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "equations/definition.hpp"
#include "equations/detail/kernel_writer.hpp"
#include "equations/detail/lowering.hpp"
#include "expression/differentiate.hpp"
#include "expression/print.hpp"
#include "expression/tape.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// What follows a jump of the phase is told by conditions, signs and whole parts: in these, the
// phase is one inside the segment. A table that jumps is told on which side it is read.
std::vector<NodeId> one_sided(Formula* formula, const std::vector<NodeId>& values, NodeId inside) {
  ExpressionGraph* graph = &formula->graph;
  Rewriter to_inside(graph, {{formula->phase, inside}});
  std::map<NodeId, NodeId> replaced;
  for (const NodeId id : parts_of(*graph, values)) {
    const Operation operation = (*graph)[id].operation;
    if (operation == Operation::table && !(*graph)[id].table->jumps().empty()) {
      replaced[id] = graph->with_arguments(id, {formula->phase, inside});
    }
    const bool jumps =
        is_condition(operation) || operation == Operation::sign || operation == Operation::floor;
    if (jumps) replaced[id] = to_inside(id);
  }
  Rewriter rewrite(graph, std::move(replaced));
  std::vector<NodeId> out;
  for (const NodeId id : values) out.push_back(rewrite(id));
  return out;
}

// All that the host works out, in double.
struct Tapes {
  // Of parameters and choices of options; coefs: then of the phase and one inside.
  Tape period, start, jumps, coefs, point;
  // Of states, point and coefs.
  Tape rhs, jacobian, signals;
  struct OfContact {
    Tape direction, direction_slope;  // [state], [state][state]
    Tape gradients;                   // of the deflection, then of the backlash, [state]
  };
  Tape contact_places;  // deflection and backlash of each
  std::vector<OfContact> contacts;
  std::size_t states = 0, points = 0, coef_count = 0;
  std::vector<std::size_t> choices;  // [option]: how many there are
};

// Parameters, then 1 for each choice that is made and 0 for the others.
std::vector<double> inputs_of(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> inputs = setting.parameters;
  for (std::size_t i = 0; i < tapes.choices.size(); ++i) {
    for (std::size_t choice = 0; choice < tapes.choices[i]; ++choice) {
      inputs.push_back(setting.options[i] == static_cast<int>(choice) ? 1.0 : 0.0);
    }
  }
  return inputs;
}

Tapes tapes_of(Formula* formula, const Lowered& lowered) {
  const ExpressionGraph& graph = formula->graph;
  std::vector<NodeId> parameters = formula->parameters;
  parameters.insert(parameters.end(), formula->choices.begin(), formula->choices.end());
  Tapes tapes;
  tapes.states = formula->states.size();
  tapes.points = lowered.point.size();
  tapes.coef_count = lowered.coefs.size();
  const NodeId inside = formula->graph.symbol("inside");
  const std::vector<NodeId> coefs = one_sided(formula, lowered.coef_values, inside);
  std::vector<NodeId> phased = parameters;
  phased.push_back(formula->phase);
  phased.push_back(inside);
  std::vector<NodeId> moment = formula->states;
  moment.insert(moment.end(), lowered.point.begin(), lowered.point.end());
  moment.insert(moment.end(), lowered.coefs.begin(), lowered.coefs.end());
  tapes.period = Tape(graph, parameters, {formula->period});
  tapes.start = Tape(graph, parameters, formula->start);
  tapes.jumps = Tape(graph, parameters, formula->jumps);
  tapes.coefs = Tape(graph, phased, coefs);
  tapes.point = Tape(graph, parameters, lowered.point_values);
  tapes.rhs = Tape(graph, moment, lowered.equations);
  tapes.jacobian = Tape(graph, moment, lowered.jacobian);
  tapes.signals = Tape(graph, moment, lowered.signals);
  std::vector<NodeId> places;
  for (const Contact& contact : lowered.contacts.list) {
    places.push_back(contact.deflection);
    places.push_back(contact.backlash);
    const auto slopes = [&](const std::vector<NodeId>& of) {
      std::vector<NodeId> out;
      for (const NodeId id : of) {
        for (const NodeId state : formula->states) {
          out.push_back(derivative(&formula->graph, id, state));
        }
      }
      return Tape(graph, moment, out);
    };
    tapes.contacts.push_back({Tape(graph, moment, contact.direction), slopes(contact.direction),
                              slopes({contact.deflection, contact.backlash})});
  }
  tapes.contact_places = Tape(graph, moment, places);
  return tapes;
}

class TextPoint final : public PreparedPoint {
 public:
  TextPoint(std::shared_ptr<const Tapes> tapes, const ModelSetting& setting)
      : tapes_(std::move(tapes)), moment_(tapes_->states + tapes_->points + tapes_->coef_count) {
    const std::vector<double> inputs = inputs_of(*tapes_, setting);
    period_ = tapes_->period.run(inputs);
    tapes_->point.run(inputs.data(), moment_.data() + tapes_->states);
  }

  double period() const override { return period_; }
  void rhs(const double* coefs, const double* x, double* dx) const override {
    run(tapes_->rhs, coefs, x, dx);
  }
  void jacobian(const double* coefs, const double* x, double* out) const override {
    run(tapes_->jacobian, coefs, x, out);
  }
  void signals(const double* coefs, const double* x, double* out) const override {
    run(tapes_->signals, coefs, x, out);
  }
  void contact_places(const double* coefs, const double* x, double* out) const override {
    run(tapes_->contact_places, coefs, x, out);
  }
  void force_direction(std::size_t contact, const double* coefs, const double* x,
                       double* out) const override {
    run(tapes_->contacts[contact].direction, coefs, x, out);
  }
  void force_direction_slope(std::size_t contact, const double* coefs, const double* x,
                             double* out) const override {
    run(tapes_->contacts[contact].direction_slope, coefs, x, out);
  }
  void penetration_gradient(const ContactLimit& limit, const double* coefs, const double* x,
                            double* out) const override {
    std::vector<double> gradients(2 * tapes_->states);
    run(tapes_->contacts[limit.contact].gradients, coefs, x, gradients.data());
    for (std::size_t j = 0; j < tapes_->states; ++j) {
      out[j] = gradients[j] - limit.flank * gradients[tapes_->states + j];
    }
  }

 private:
  void run(const Tape& tape, const double* coefs, const double* x, double* out) const {
    std::vector<double> moment = moment_;
    std::copy_n(x, tapes_->states, moment.begin());
    std::copy_n(coefs, tapes_->coef_count,
                moment.end() - static_cast<std::ptrdiff_t>(tapes_->coef_count));
    tape.run(moment.data(), out);
  }

  std::shared_ptr<const Tapes> tapes_;
  double period_ = 0.0;
  std::vector<double> moment_;  // states, point, coefs
};

std::string check_of(const Tapes& tapes, const ModelSetting& setting) {
  const double period = tapes.period.run(inputs_of(tapes, setting));
  if (std::isfinite(period) && period > 0.0) return "";
  return fmt::format("the forcing period is {}; it must be a finite number above 0", period);
}

// In [0, 1), as all begin with 0.
std::vector<double> jumps_of(const Tapes& tapes, std::size_t count, const ModelSetting& setting) {
  std::vector<double> phases(count + 1);
  tapes.jumps.run(inputs_of(tapes, setting).data(), phases.data() + 1);
  for (double& phase : phases) {
    phase /= kTurn;
    phase -= std::floor(phase);
  }
  return phases;
}

void set_lists(const ModelDefinition& definition, const Formula& formula, const Lowered& lowered,
               Model* model) {
  model->name = definition.name;
  model->summary = definition.summary;
  model->states = definition.states;
  model->signals = definition.signals;
  model->parameters = definition.parameters;
  model->options = definition.options;
  model->presets = definition.presets;
  model->max_step = definition.max_step;
  model->text = definition.text;
  for (std::size_t i = 0; i < model->parameters.size(); ++i) {
    model->parameters[i].shapes_phase = lowered.shapes_phase[i];
  }
  for (std::size_t i = 0; i < model->states.size(); ++i) {
    if (definition.are_angles[i]) model->angles.push_back(i);
  }
  for (std::size_t i = 0; i < lowered.coefs.size(); ++i) {
    model->phase_coefs.push_back(
        {fmt::format("w{}", i), "", to_short_text(formula.graph, lowered.coef_values[i])});
  }
  // As a header without any has (kernels/model_types.h).
  if (lowered.coefs.empty()) {
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

void refuse_taken(const ModelDefinition& definition, const std::string& name) {
  const auto is_taken = [&](const auto& infos) {
    return std::ranges::any_of(infos, [&](const auto& info) { return info.name == name; });
  };
  if (!is_taken(definition.states) && !is_taken(definition.signals)) return;
  throw InputError(fmt::format(
      "{}: '{}' is what a signal of one of the model's contacts is called; take another name",
      definition.period.file, name));
}

// Of equations with these options: all that jumps in what no choice takes away.
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
  return find_corners(&formula, equations).jumps;
}

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

// What no option changes: where there are none, or nothing jumps whatever they are.
std::function<std::vector<StateJump>(const ModelSetting&)> state_jumps_by_setting(
    const ModelDefinition& definition, const std::shared_ptr<const Formula>& written,
    const Lowered& lowered) {
  std::vector<StateJump> all = state_jumps_of(definition, lowered.jumps);
  if (all.empty() || definition.options.empty()) {
    return [all = std::move(all)](const ModelSetting&) { return all; };
  }
  const auto defined = std::make_shared<const ModelDefinition>(definition);
  return [defined, written](const ModelSetting& setting) {
    return state_jumps_of(*defined, jumps_with(setting, *defined, *written));
  };
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
      refuse_taken(*definition, before + name);
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

std::vector<std::string> findings_of(const ModelDefinition& definition, const Formula& formula,
                                     const Lowered& lowered) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) { lines.push_back(line); };
  const ExpressionGraph& graph = formula.graph;
  if (lowered.is_second_order) add("second order: positions, then their velocities");
  for (const StateJump& jump : state_jumps_of(definition, lowered.jumps)) {
    add(
        fmt::format("jumps with a state: {} (in {}); steps are of first order there, and there are "
                    "no exponents, periods and kinds of motion",
                    jump.expression, jump.place));
  }
  for (const Contact& contact : lowered.contacts.list) {
    if (contact.is_hidden) {
      add(fmt::format("corner of {}: steps that cross it are corrected", contact.name));
      continue;
    }
    const std::string name = contact.name.empty() ? "" : fmt::format(" '{}'", contact.name);
    const bool has_slope = std::ranges::any_of(
        contact.direction, [&](NodeId id) { return !graph.is_number(id, 0.0); });
    add(fmt::format("{}{}: {}", contact.is_one_sided ? "stop" : "backlash", name,
                    has_slope ? "steps that cross its limits are corrected"
                              : "the force does not begin with a slope: steps are not corrected"));
  }
  for (const RoughPlace& place : lowered.uncorrected) {
    add(fmt::format("corner of {} (in {}): steps are not corrected, and of second order there",
                    place.expression, equation_of(definition, place)));
  }
  for (const NodeId id : lowered.coef_values) {
    add(fmt::format("tabulated over the phase: {}", to_short_text(graph, id)));
  }
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    if (!lowered.shapes_phase[i] || !formula.are_swept[i]) continue;
    add(fmt::format("'{}' cannot be parted from the phase: each of its values has a table",
                    definition.parameters[i].name));
  }
  return lines;
}

}  // namespace

Model make_model(const ModelDefinition& given) {
  ModelDefinition definition = given;
  Formula formula = parse_formula(definition);
  const auto written = std::make_shared<const Formula>(formula);
  Lowered lowered = lower(&formula);
  const std::vector<ContactInfo> contacts = add_contact_signals(formula, &definition, &lowered);
  Tapes worked_out = tapes_of(&formula, lowered);
  for (const OptionInfo& option : definition.options) {
    worked_out.choices.push_back(option.choices.size());
  }
  const auto tapes = std::make_shared<const Tapes>(std::move(worked_out));
  Model model;
  set_lists(definition, formula, lowered, &model);
  model.contacts = contacts;
  model.corners = lowered.contacts.list.size() - contacts.size();
  for (const RoughPlace& place : lowered.uncorrected) {
    model.uncorrected.push_back(
        fmt::format("{} (in {})", place.expression, equation_of(definition, place)));
  }
  model.state_jumps = state_jumps_by_setting(definition, written, lowered);
  model.findings = findings_of(definition, formula, lowered);
  model.kernel = kernel_of(definition, &formula, lowered);
  const std::size_t jumps = formula.jumps.size();
  model.check = [tapes](const ModelSetting& setting) { return check_of(*tapes, setting); };
  model.break_phases = [tapes, jumps](const ModelSetting& setting) {
    return jumps_of(*tapes, jumps, setting);
  };
  model.phase_coefs_at = [tapes](const ModelSetting& setting, double psi, double inside,
                                 double* row) {
    row[0] = 1.0;
    std::vector<double> inputs = inputs_of(*tapes, setting);
    inputs.push_back(kTurn * psi);
    inputs.push_back(kTurn * inside);
    tapes->coefs.run(inputs.data(), row);
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
  return model;
}

}  // namespace gearsweep
