#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "equations/definition.hpp"
#include "equations/detail/kernel_size.hpp"
#include "equations/detail/kernel_writer.hpp"
#include "equations/detail/lowering.hpp"
#include "equations/detail/one_sided.hpp"
#include "equations/detail/phase_breaks.hpp"
#include "equations/detail/phase_waves.hpp"
#include "equations/field_graph.hpp"
#include "expression/differentiate.hpp"
#include "expression/print.hpp"
#include "expression/tape.hpp"
#include "model/error.hpp"
#include "model/range_groups.hpp"

namespace gearsweep {
namespace {

// Break phases closer than this are one (plan/phase_grid.cpp).
constexpr double kSamePhase = 1e-9;

// All that the host works out, in double.
struct Tapes {
  // Of parameters and choices of options; coefs: then of the phase and one inside.
  Tape period, start, jumps, coefs, point;
  // Of states, point and coefs.
  Tape rhs, jacobian, signals;
  // Of coefs.
  PhaseBreaks breaks;
  PhaseWaves waves;
  struct OfContact {
    Tape direction, direction_slope;  // [state], [state][state]
    Tape gradients;                   // of the deflection, then of the backlash, [state]
  };
  Tape contact_places;  // deflection and backlash of each
  std::vector<OfContact> contacts;
  std::size_t states = 0, points = 0, coef_count = 0;
  std::vector<std::size_t> choices;  // [option]: how many there are
  std::size_t listed = 0;            // jumps that the model's file lists
  std::string file;                  // of the model, for messages
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
  tapes.listed = formula->jumps.size();
  tapes.breaks = PhaseBreaks(graph, parameters, formula->phase, lowered.coef_values);
  tapes.waves = PhaseWaves(&formula->graph, parameters, formula->phase, lowered.coef_values);
  // No name of a user's has a space.
  const NodeId inside = formula->graph.symbol("phase inside");
  const std::vector<NodeId> coefs =
      one_sided(&formula->graph, formula->phase, inside, lowered.coef_values);
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
  const std::vector<double> inputs = inputs_of(tapes, setting);
  const double period = tapes.period.run(inputs);
  if (std::isfinite(period) && period > 0.0) return tapes.waves.check(inputs, tapes.breaks);
  return fmt::format("the forcing period is {}; it must be a finite number above 0", period);
}

double share_of(double phase) {
  const double share = phase / kWholePhase;
  return share - std::floor(share);
}

// In [0, 1): phase 0 and what the model's file lists.
std::vector<double> listed_phases(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> phases(tapes.listed + 1);
  tapes.jumps.run(inputs_of(tapes, setting).data(), phases.data() + 1);
  for (double& phase : phases) phase = share_of(phase);
  return phases;
}

std::vector<double> found_phases(const Tapes& tapes, const ModelSetting& setting) {
  try {
    std::vector<double> phases = tapes.breaks.find(inputs_of(tapes, setting));
    for (double& phase : phases) phase = share_of(phase);
    return phases;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", tapes.file, error.what()));
  }
}

bool is_near(double phase, const std::vector<double>& phases) {
  return std::ranges::any_of(phases, [&](double other) {
    const double distance = std::fabs(phase - other);
    return std::min(distance, 1.0 - distance) <= kSamePhase;
  });
}

// What the file lists stands as it is: rounding may have found it a little elsewhere.
std::vector<double> break_phases_of(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> phases = listed_phases(tapes, setting);
  const std::vector<double> listed = phases;
  for (const double phase : found_phases(tapes, setting)) {
    if (!is_near(phase, listed)) phases.push_back(phase);
  }
  return phases;
}

void coefs_at(const Tapes& tapes, const ModelSetting& setting, double psi, double inside,
              double* row) {
  row[0] = 1.0;  // of a model without coefficients
  std::vector<double> inputs = inputs_of(tapes, setting);
  inputs.push_back(kWholePhase * psi);
  inputs.push_back(kWholePhase * inside);
  tapes.coefs.run(inputs.data(), row);
}

// The breaks at which a coefficient has two values; breaks: rising, within (0, 1).
std::vector<double> jumps_among(const Tapes& tapes, const ModelSetting& setting,
                                const std::vector<double>& breaks) {
  constexpr double kRounding = 1e-9;
  std::vector<double> jumps, before(tapes.coef_count), after(tapes.coef_count);
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double from = i == 0 ? 0.0 : breaks[i - 1];
    const double to = i + 1 < breaks.size() ? breaks[i + 1] : 1.0;
    coefs_at(tapes, setting, breaks[i], 0.5 * (from + breaks[i]), before.data());
    coefs_at(tapes, setting, breaks[i], 0.5 * (breaks[i] + to), after.data());
    bool jumps_here = false;
    for (std::size_t j = 0; j < before.size(); ++j) {
      const double size = std::max(std::fabs(before[j]), std::fabs(after[j]));
      jumps_here |= std::fabs(after[j] - before[j]) > kRounding * size;
    }
    if (jumps_here) jumps.push_back(breaks[i]);
  }
  return jumps;
}

std::string radians(const std::vector<double>& phases) {
  std::vector<std::string> texts;
  for (const double phase : phases) texts.push_back(fmt::format("{:.6g}", kWholePhase * phase));
  return fmt::format("{} {}", phases.size() == 1 ? "phase" : "phases", fmt::join(texts, ", "));
}

// The list of jumps is a promise: whether it holds at a setting. A model that lists none promises
// nothing.
std::vector<std::string> broken_promises(const Tapes& tapes, const ModelSetting& setting) {
  if (tapes.listed == 0) return {};
  const std::vector<double> found = found_phases(tapes, setting);
  const std::vector<double> listed = listed_phases(tapes, setting);
  std::vector<double> missed, idle;
  for (const double phase : jumps_among(tapes, setting, found)) {
    if (!is_near(phase, listed)) missed.push_back(phase);
  }
  for (const double phase : listed) {
    if (!is_near(phase, found) && !is_near(phase, {0.0})) idle.push_back(phase);
  }
  std::vector<std::string> notices;
  if (!missed.empty()) {
    notices.push_back(fmt::format(
        "{}: the equations jump at {}, which [forcing] jumps does not list; steps end there, too",
        tapes.file, radians(missed)));
  }
  if (!idle.empty()) {
    notices.push_back(fmt::format("{}: [forcing] jumps lists {}, where no equation jumps",
                                  tapes.file, radians(idle)));
  }
  return notices;
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
  model->max_step = definition.max_step;
  model->text = definition.text;
  for (std::size_t i = 0; i < model->parameters.size(); ++i) {
    const std::vector<NodeId> parts = parts_of(formula.graph, formula.jumps);
    const bool moves_jump = std::ranges::find(parts, formula.parameters[i]) != parts.end();
    model->parameters[i].shapes_phase = lowered.shapes_phase[i] || moves_jump;
  }
  for (std::size_t i = 0; i < model->states.size(); ++i) {
    if (definition.are_angles[i]) model->angles.push_back(i);
  }
  model->range_groups = range_groups_of(definition.groups);
  model->diverged_above = definition.diverged_above;
  for (std::size_t i = 0; i < lowered.coefs.size(); ++i) {
    model->phase_coefs.push_back(
        {fmt::format("w{}", i), "", to_short_text(formula.graph, lowered.coef_values[i])});
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
                                     const Lowered& lowered, const PhaseBreaks& breaks) {
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
  for (const std::string& text : breaks.texts()) {
    add(fmt::format("steps end at the phases where this jumps or bends: {}", text));
  }
  for (const std::string& line : breaks.tables_left_out()) add(line);
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    if (!lowered.shapes_phase[i] || !formula.are_swept[i]) continue;
    add(fmt::format("'{}' cannot be parted from the phase: each of its values has a table",
                    definition.parameters[i].name));
  }
  return lines;
}

// The signals of contacts are lowered ones: back to what these are made of.
std::shared_ptr<const FieldGraph> field_graph_of(const Formula& formula, const Lowered& lowered) {
  auto field =
      std::make_shared<FieldGraph>(FieldGraph{formula.graph, formula.states, formula.parameters,
                                              formula.choices, formula.equations, formula.signals});
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
  worked_out.file = definition.period.file;
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
  model.findings = findings_of(definition, formula, lowered, tapes->breaks);
  model.is_rough = !tapes->breaks.tables_left_out().empty();
  model.field = field_graph_of(formula, lowered);
  model.unused = formula.unused;
  model.kernel = kernel_of(definition, &formula, lowered, model.is_rough);
  refuse_large_kernel(definition, formula, lowered, model.kernel);
  model.check = [tapes](const ModelSetting& setting) { return check_of(*tapes, setting); };
  model.notices = [tapes](const ModelSetting& setting) { return broken_promises(*tapes, setting); };
  model.break_phases = [tapes](const ModelSetting& setting) {
    return break_phases_of(*tapes, setting);
  };
  model.phase_coefs_at = [tapes](const ModelSetting& setting, double psi, double inside,
                                 double* row) { coefs_at(*tapes, setting, psi, inside, row); };
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
