#include "equations/detail/kernel_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "equations/detail/statements.hpp"
#include "equations/detail/tangent_program.hpp"
#include "expression/differentiate.hpp"
#include "expression/print.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

class KernelWriter {
 public:
  KernelWriter(const ModelDefinition& definition, Formula* formula, const Lowered& lowered,
               const TangentProgram& tangent, bool is_rough)
      : definition_(definition),
        formula_(formula),
        graph_(&formula->graph),
        lowered_(lowered),
        is_rough_(is_rough),
        tangent_(tangent) {
    const auto name = [&](const std::vector<NodeId>& symbols) {
      for (const NodeId id : symbols) names_[id] = (*graph_)[id].symbol;
    };
    name(lowered.point);
    name(lowered.coefs);
    name(lowered.contacts.along);
    for (std::size_t i = 0; i < formula->states.size(); ++i) {
      names_[formula->states[i]] = fmt::format("x[{}]", state_index(i));
    }
    for (std::size_t i = 0; i < formula->parameters.size(); ++i) {
      names_[formula->parameters[i]] =
          fmt::format("p->{}", kernel_name(definition.parameters[i].name));
    }
    std::size_t choice = 0;
    for (const OptionInfo& option : definition.options) {
      for (std::size_t i = 0; i < option.choices.size() && !formula->choices.empty(); ++i) {
        names_[formula->choices[choice++]] =
            fmt::format("(scalar)(options.{} == {})", kernel_name(option.name), i);
      }
    }
    for (std::size_t i = 0; i < lowered.surfaces.size(); ++i) {
      names_[lowered.surfaces[i].side] = fmt::format("point->sides.side[{}]", i);
    }
    for (std::size_t i = 0; i < lowered.contacts.list.size(); ++i) {
      if (lowered.contacts.list[i].is_hidden) break;
      names_[lowered.contacts.list[i].penetration] = fmt::format("penetration{}", i);
    }
    name_tangents();
  }

  std::string text() {
    write_heading();
    write_lists();
    write_point();
    if (has_contacts()) {
      write_contacts();
    } else {
      write_function("model_rhs",
                     "const ModelPoint* point, const PhaseAt* phase, const real* x, real* dx",
                     places("dx", lowered_.equations), "point phase x");
    }
    write_linearization();
    if (!lowered_.surfaces.empty()) write_surfaces();
    std::vector<Assignment> signals;
    for (std::size_t i = 0; i < definition_.signals.size(); ++i) {
      signals.emplace_back("signals->" + kernel_name(definition_.signals[i].name),
                           lowered_.signals[i]);
    }
    write_function("model_signals",
                   "const ModelPoint* point, const PhaseAt* phase, const real* x, "
                   "ModelSignals* signals",
                   signals, "point phase x");
    return out_;
  }

 private:
  void name_tangents() {
    names_[tangent_.scale] = "scale";
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      names_[tangent_.tangent[i]] = fmt::format("w[{}]", state_index(i));
      names_[tangent_.base[i]] = fmt::format("base[{}]", state_index(i));
    }
    for (std::size_t i = 0; i < tangent_.fields.size(); ++i) {
      names_[tangent_.fields[i]] = fmt::format("linear->j{}", i);
    }
    for (std::size_t i = 0; i < tangent_.point.size(); ++i) {
      names_[tangent_.point[i]] = fmt::format("point->c{}", lowered_.point.size() + i);
    }
  }

  // Printed from the tree, as all that is of the file: nothing of its text can end the comment.
  void write_heading() {
    out_ += fmt::format("// {}: written from its equations.\n", definition_.name);
    if (lowered_.coefs.empty()) return;
    out_ += "// Tabulated over the phase:\n";
    for (std::size_t i = 0; i < lowered_.coefs.size(); ++i) {
      out_ += fmt::format("//   w{} = {}\n", i,
                          to_short_text(*graph_, lowered_.coef_values[i], formula_->names));
    }
  }

  std::string state_index(std::size_t state) const {
    return "STATE_" + kernel_name(definition_.states[state].name);
  }

  bool has_contacts() const { return !lowered_.contacts.list.empty(); }

  std::vector<Assignment> places(const std::string& array, const std::vector<NodeId>& ids) const {
    std::vector<Assignment> out;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      out.emplace_back(fmt::format("{}[{}]", array, state_index(i)), ids[i]);
    }
    return out;
  }

  // unused: what the function may do without.
  void write_function(const std::string& name, const std::string& arguments,
                      const std::vector<Assignment>& assignments, const std::string& unused,
                      const std::string& before = "") {
    out_ += fmt::format("\nSHARED_FN void {}({}) {{\n", name, arguments);
    std::size_t begin = 0;
    while (begin < unused.size()) {
      const std::size_t end = std::min(unused.find(' ', begin), unused.size());
      out_ += fmt::format("  (void){};\n", unused.substr(begin, end - begin));
      begin = end + 1;
    }
    out_ += before + statements_of(*graph_, assignments, names_) + "}\n";
  }

  void write_list(const std::string& macro, const std::vector<std::string>& rows) {
    out_ += fmt::format("#define {}(X)", macro);
    for (const std::string& row : rows) out_ += fmt::format(" \\\n  X({})", row);
    out_ += "\n";
  }

  void write_lists() {
    std::vector<std::string> states, parameters, signals, coefs;
    for (const ChannelInfo& state : definition_.states)
      states.push_back(kernel_name(state.name) + ", 0, 0");
    for (const ParameterInfo& parameter : definition_.parameters) {
      parameters.push_back(kernel_name(parameter.name) + ", 0, 0, 0, 0, 0, 0");
    }
    for (const ChannelInfo& signal : definition_.signals)
      signals.push_back(kernel_name(signal.name) + ", 0, 0");
    for (std::size_t i = 0; i < lowered_.coefs.size(); ++i) {
      coefs.push_back(fmt::format("w{}, 0", i));
    }
    write_list("MODEL_STATES", states);
    if (!parameters.empty()) write_list("MODEL_PARAMETERS", parameters);
    write_list("MODEL_SIGNALS", signals);
    if (!coefs.empty()) write_list("MODEL_PHASE_COEFS", coefs);
    if (!definition_.options.empty()) {
      std::vector<std::string> options;
      for (const OptionInfo& option : definition_.options) {
        options.push_back(kernel_name(option.name) + ", 0, 0");
      }
      write_list("MODEL_OPTIONS", options);
    }
    std::vector<std::string> angles;
    for (std::size_t i = 0; i < definition_.states.size(); ++i) {
      if (definition_.are_angles[i]) angles.push_back(kernel_name(definition_.states[i].name));
    }
    if (!angles.empty()) write_list("MODEL_ANGLES", angles);
    if (definition_.clock) out_ += "#define MODEL_CLOCKLESS\n";
    if (definition_.second) out_ += "#define MODEL_CLOCKS 1\n";
    if (lowered_.is_second_order) out_ += "#define MODEL_SECOND_ORDER\n";
    if (is_rough_) out_ += "#define MODEL_ROUGH\n";
    if (has_contacts()) write_contact_lists();
    if (!lowered_.surfaces.empty()) write_surface_lists();
    out_ += "\n#include \"model_types.h\"\n";
  }

  void write_point() {
    out_ += "\n// What a point needs in the inner loop.\ntypedef struct {\n  real period;\n";
    std::vector<Assignment> assignments;
    const auto add = [&](const std::vector<NodeId>& symbols, const std::vector<NodeId>& values) {
      for (std::size_t i = 0; i < symbols.size(); ++i) {
        out_ += fmt::format("  real c{};  // {}\n", assignments.size(),
                            to_short_text(*graph_, values[i], formula_->names));
        assignments.emplace_back(names_.at(symbols[i]), values[i]);
      }
    };
    add(lowered_.point, lowered_.point_values);
    add(tangent_.point, tangent_.point_values);
    if (!lowered_.surfaces.empty()) out_ += "  Sides sides;  // that are held\n";
    out_ += "} ModelPoint;\n";
    // A period that only counts time is given to the kernels as a number (items.h): a program does
    // not depend on what a study's motions were found to take.
    if (!definition_.clock) {
      assignments.insert(assignments.begin(), {"point->period", formula_->period});
    }
    write_function("model_prepare",
                   "const ModelParameters* p, ModelOptions options, ModelPoint* point", assignments,
                   "p options");
  }

  void write_contact_lists() {
    const std::vector<Contact>& contacts = lowered_.contacts.list;
    std::vector<std::string> signals;
    std::string one_sided;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const std::string before = contacts[i].name.empty() ? "" : contacts[i].name + "_";
      if (!contacts[i].is_hidden) {
        signals.push_back(fmt::format("{}, {}, {}", i, kernel_name(before + "deflection"),
                                      kernel_name(before + "backlash")));
      }
      if (!contacts[i].is_one_sided) continue;
      one_sided += fmt::format("{}(contact) == {}", one_sided.empty() ? "" : " || ", i);
    }
    out_ += fmt::format("#define MODEL_CONTACT\n#define MODEL_CONTACTS {}\n", contacts.size());
    out_ +=
        fmt::format("#define MODEL_ONE_SIDED(contact) ({})\n", one_sided.empty() ? "0" : one_sided);
    write_list("MODEL_CONTACT_SIGNALS", signals);
    if (lowered_.contacts.has_feedback) out_ += "#define MODEL_CONTACT_FEEDBACK\n";
    if (lowered_.contacts.direction_varies) out_ += "#define MODEL_FORCE_DIRECTION_VARIES\n";
  }

  // The surfaces of which that holds, as a condition of `surface`.
  std::string surfaces_where(const std::function<bool(const Surface&)>& holds) const {
    std::string found;
    for (std::size_t i = 0; i < lowered_.surfaces.size(); ++i) {
      if (!holds(lowered_.surfaces[i])) continue;
      found += fmt::format("{}(surface) == {}", found.empty() ? "" : " || ", i);
    }
    return found.empty() ? "0" : found;
  }

  void write_surface_lists() {
    out_ += fmt::format("#define MODEL_SURFACES {}\n#define MODEL_STAIRCASE(surface) ({})\n",
                        lowered_.surfaces.size(), surfaces_where(&Surface::is_staircase));
    std::vector<std::string> slopes;
    for (const auto& [coef, slope] : lowered_.phase_slopes) {
      slopes.push_back(fmt::format("w{}, w{}", coef, slope));
    }
    write_list("MODEL_PHASE_SLOPES", slopes);
    if (!has_resets()) return;
    out_ += fmt::format("#define MODEL_HAS_RESETS\n#define MODEL_RESETS(surface) ({})\n",
                        surfaces_where(is_reset));
  }

  static bool is_reset(const Surface& surface) { return !surface.reset.empty(); }
  bool has_resets() const { return std::ranges::any_of(lowered_.surfaces, is_reset); }

  NodeId change_along(NodeId value, const std::vector<NodeId>& by) {
    NodeId all = graph_->number(0.0);
    for (std::size_t i = 0; i < by.size(); ++i) {
      const NodeId slope = derivative(graph_, value, formula_->states[i]);
      all = graph_->make(Operation::add, {all, graph_->make(Operation::multiply, {slope, by[i]})});
    }
    return all;
  }

  // Values of all surfaces; how they change along dx while the phase stands still, and in time;
  // and, of what is held, how that changes along a tangent vector while dx stays.
  void write_values(const std::string& name, NodeId Surface::*value, NodeId Surface::*drift) {
    std::vector<Assignment> values, along, rates, bends;
    for (std::size_t i = 0; i < lowered_.surfaces.size(); ++i) {
      const Surface& surface = lowered_.surfaces[i];
      const NodeId still = change_along(surface.*value, dx_);
      const NodeId rate = graph_->make(Operation::add, {still, surface.*drift});
      values.emplace_back(fmt::format("levels[{}]", i), surface.*value);
      along.emplace_back(fmt::format("rates[{}]", i), still);
      rates.emplace_back(fmt::format("rates[{}]", i), rate);
      bends.emplace_back(fmt::format("bends[{}]", i), change_along(rate, w_));
    }
    const std::string at = "const ModelPoint* point, const PhaseAt* phase, const real* x, ";
    write_function(fmt::format("model_{}_values", name), at + "real* levels", values,
                   "point phase x");
    write_function(fmt::format("model_{}_along", name), at + "const real* dx, real* rates", along,
                   "point phase x dx");
    write_function(fmt::format("model_{}_rates", name), at + "const real* dx, real* rates", rates,
                   "point phase x dx");
    if (name != "held" && has_resets()) return;
    write_function(fmt::format("model_{}_bends", name),
                   at + "const real* dx, const real* w, real* bends", bends, "point phase x dx w");
  }

  void write_surfaces() {
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      dx_.push_back(graph_->symbol(fmt::format("dx[{}]", i)));
      w_.push_back(graph_->symbol(fmt::format("w[{}]", i)));
      names_[dx_.back()] = fmt::format("dx[{}]", state_index(i));
      names_[w_.back()] = fmt::format("w[{}]", state_index(i));
    }
    write_function("model_phase_turn", "const ModelPoint* point, real* turn",
                   {{"*turn", lowered_.phase_turn}}, "point");
    write_values("level", &Surface::level, &Surface::drift);
    if (!has_resets()) {
      for (const char* what : {"values", "along", "rates", "bends"}) {
        out_ += fmt::format("#define model_held_{0} model_level_{0}\n", what);
      }
      return;
    }
    write_values("held", &Surface::held, &Surface::held_drift);
    std::vector<std::vector<Assignment>> resets, along, rates, turns;
    for (const Surface& surface : lowered_.surfaces) {
      const bool resets_it = is_reset(surface);
      std::vector<NodeId> carried, moved;
      for (std::size_t i = 0; i < formula_->states.size(); ++i) {
        carried.push_back(resets_it ? change_along(surface.reset[i], dx_) : dx_[i]);
        moved.push_back(resets_it
                            ? graph_->make(Operation::add, {carried[i], surface.reset_drift[i]})
                            : dx_[i]);
      }
      resets.push_back(places("out", resets_it ? surface.reset : formula_->states));
      along.push_back(places("out", carried));
      rates.push_back(places("out", moved));
      turns.push_back(resets_it ? places("out", surface.turn) : std::vector<Assignment>());
    }
    const std::string at = "const ModelPoint* point, const PhaseAt* phase, const real* x, ";
    write_by_contact("model_reset", at + "real* out", "point phase x out", resets);
    write_by_contact("model_reset_along", at + "const real* dx, real* out", "point phase x dx out",
                     along);
    write_by_contact("model_reset_rates", at + "const real* dx, real* out", "point phase x dx out",
                     rates);
    write_by_contact("model_reset_turn", at + "real* out", "point phase x out", turns);
  }

  // A backlash that is never negative takes fewer operations.
  static std::string penetration_text(const Contact& contact, std::size_t index) {
    const std::string name = fmt::format("  const real penetration{} =\n      ", index);
    const std::string seen = fmt::format("contacts[{}].", index);
    if (contact.is_one_sided) {
      return fmt::format("{0}lane_max({1}deflection - {1}backlash, (real)(0));\n", name, seen);
    }
    if (!contact.may_be_negative) {
      return fmt::format(
          "{0}{1}deflection -\n      lane_clamp({1}deflection, -{1}backlash, {1}backlash);\n", name,
          seen);
    }
    return fmt::format(
        "{0}lane_max({1}deflection - {1}backlash, (real)(0)) +\n"
        "      lane_min({1}deflection + {1}backlash, (real)(0));\n",
        name, seen);
  }

  void write_contacts() {
    const Contacts& contacts = lowered_.contacts;
    const std::string at_state = "const ModelPoint* point, const PhaseAt* phase, const real* x, ";
    std::vector<Assignment> seen, along;
    std::string penetrations;
    for (std::size_t i = 0; i < contacts.list.size(); ++i) {
      const Contact& contact = contacts.list[i];
      seen.emplace_back(fmt::format("contacts[{}].deflection", i), contact.deflection);
      seen.emplace_back(fmt::format("contacts[{}].backlash", i), contact.backlash);
      along.emplace_back(fmt::format("added[{}].deflection", i), contacts.deflection_along[i]);
      along.emplace_back(fmt::format("added[{}].backlash", i), contacts.backlash_along[i]);
      if (!contact.is_hidden) penetrations += penetration_text(contact, i);
    }
    write_function("model_contact", at_state + "ModelContact* contacts", seen, "point phase x");
    write_function("model_rhs_in_contact", at_state + "const ModelContact* contacts, real* dx",
                   places("dx", contacts.equations),
                   penetrations.empty() ? "point phase x contacts" : "point phase x", penetrations);
    out_ += fmt::format(
        "\nSHARED_FN void model_rhs({}real* dx) {{\n"
        "  ModelContact contacts[MODEL_CONTACTS];\n"
        "  model_contact(point, phase, x, contacts);\n"
        "  model_rhs_in_contact(point, phase, x, contacts, dx);\n}}\n",
        at_state);
    write_directions(at_state);
    write_function("model_force_direction_carried", at_state + "const real* direction, real* dx",
                   places("dx", contacts.carried), "point phase x direction");
    if (contacts.has_feedback) {
      write_function("model_contact_along", at_state + "const real* direction, ModelContact* added",
                     along, "point phase x direction");
    }
  }

  // A function for each contact, and one that chooses among them.
  void write_by_contact(const std::string& name, const std::string& parameters,
                        const std::string& arguments,
                        const std::vector<std::vector<Assignment>>& bodies) {
    std::string choice;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      write_function(fmt::format("{}{}", name, i), parameters, bodies[i], arguments);
      std::string list = arguments;
      for (std::size_t at = 0; (at = list.find(' ', at)) != std::string::npos; at += 2) {
        list.replace(at, 1, ", ");
      }
      choice += fmt::format("  if (contact == {}) {}{}({});\n", i, name, i, list);
    }
    std::string with_contact = parameters;
    with_contact.replace(with_contact.find("const real* x, "), 15, "const real* x, int contact, ");
    out_ += fmt::format("\nSHARED_FN void {}({}) {{\n{}}}\n", name, with_contact, choice);
  }

  void write_directions(const std::string& at_state) {
    std::vector<std::vector<Assignment>> directions, turned;
    for (const Contact& contact : lowered_.contacts.list) {
      directions.push_back(places("direction", contact.direction));
      turned.push_back(places("out", turned_by_tangent(contact.direction)));
    }
    write_by_contact("model_force_direction", at_state + "real* direction",
                     "point phase x direction", directions);
    if (!lowered_.contacts.direction_varies) return;
    write_by_contact("model_force_direction_tangent", at_state + "const real* w, real* out",
                     "point phase x w out", turned);
  }

  // What a tangent vector w adds to these.
  std::vector<NodeId> turned_by_tangent(const std::vector<NodeId>& values) {
    std::vector<NodeId> out;
    for (const NodeId value : values) {
      NodeId all = graph_->number(0.0);
      for (std::size_t j = 0; j < formula_->states.size(); ++j) {
        const NodeId w = graph_->symbol(fmt::format("w[{}]", j));
        names_[w] = fmt::format("w[{}]", state_index(j));
        const NodeId slope = derivative(graph_, value, formula_->states[j]);
        all = graph_->make(Operation::add, {all, graph_->make(Operation::multiply, {slope, w})});
      }
      out.push_back(all);
    }
    return out;
  }

  void write_linearization() {
    std::vector<Assignment> contact;
    for (std::size_t i = 0; i < lowered_.contacts.list.size(); ++i) {
      contact.emplace_back(fmt::format("added[{}].deflection", i), tangent_.contacts[2 * i]);
      contact.emplace_back(fmt::format("added[{}].backlash", i), tangent_.contacts[2 * i + 1]);
    }
    out_ += "\n// What the derivative at a state is made of.\ntypedef struct {\n";
    if (tangent_.fields.empty()) out_ += "  real none;\n";  // a struct must have a member
    std::vector<Assignment> assignments;
    for (std::size_t i = 0; i < tangent_.fields.size(); ++i) {
      out_ += fmt::format("  real j{};\n", i);
      assignments.emplace_back(fmt::format("linear->j{}", i), tangent_.field_values[i]);
    }
    out_ += "} ModelLinear;\n";
    write_function("model_linearize",
                   "const ModelPoint* point, const PhaseAt* phase, const real* x, real scale, "
                   "ModelLinear* linear",
                   assignments, "point phase x scale");
    const std::string arguments =
        "const ModelPoint* point, const ModelLinear* linear, const real* w, ";
    out_ += "\n// out = base + scale J w; out is neither w nor base.";
    write_function("model_tangent", arguments + "const real* base, real* out",
                   places("out", tangent_.rows), "point linear w");
    if (has_contacts()) {
      write_function("model_contact_tangent", arguments + "ModelContact* added", contact,
                     "point linear w");
    }
  }

  const ModelDefinition& definition_;
  Formula* formula_;
  ExpressionGraph* graph_;
  const Lowered& lowered_;
  const bool is_rough_;
  const TangentProgram& tangent_;
  std::map<NodeId, std::string> names_;
  std::vector<NodeId> dx_, w_;  // symbols: [state]
  std::string out_;
};

}  // namespace

std::string kernel_of(const ModelDefinition& definition, Formula* formula, const Lowered& lowered,
                      const TangentProgram& tangent, bool is_rough) {
  return KernelWriter(definition, formula, lowered, tangent, is_rough).text();
}

}  // namespace gearsweep
