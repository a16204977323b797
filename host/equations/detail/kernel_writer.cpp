#include "equations/detail/kernel_writer.hpp"

#include <fmt/format.h>

#include <utility>

#include "equations/detail/kernel_surfaces.hpp"
#include "equations/detail/kernel_text.hpp"
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
        tangent_(tangent),
        text_(&formula->graph, definition.states) {
    const auto name = [&](const std::vector<NodeId>& symbols) {
      for (const NodeId id : symbols) text_.names[id] = (*graph_)[id].symbol;
    };
    name(lowered.point);
    name(lowered.coefs);
    name(lowered.contacts.along);
    for (std::size_t i = 0; i < formula->states.size(); ++i) {
      text_.names[formula->states[i]] = fmt::format("x[{}]", text_.state_index(i));
    }
    for (std::size_t i = 0; i < formula->parameters.size(); ++i) {
      text_.names[formula->parameters[i]] =
          fmt::format("p->{}", kernel_name(definition.parameters[i].name));
    }
    std::size_t choice = 0;
    for (const OptionInfo& option : definition.options) {
      for (std::size_t i = 0; i < option.choices.size() && !formula->choices.empty(); ++i) {
        text_.names[formula->choices[choice++]] =
            fmt::format("(scalar)(options.{} == {})", kernel_name(option.name), i);
      }
    }
    for (std::size_t i = 0; i < lowered.surfaces.size(); ++i) {
      text_.names[lowered.surfaces[i].side] = fmt::format("point->sides.side[{}]", i);
    }
    for (std::size_t i = 0; i < lowered.contacts.list.size(); ++i) {
      if (lowered.contacts.list[i].is_hidden) break;
      text_.names[lowered.contacts.list[i].penetration] = fmt::format("penetration{}", i);
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
      text_.write_function("model_rhs",
                           "const ModelPoint* point, const PhaseAt* phase, const real* x, real* dx",
                           text_.places("dx", lowered_.equations), "point phase x");
    }
    write_linearization();
    if (!lowered_.surfaces.empty()) write_surfaces(formula_, lowered_, &text_);
    std::vector<Assignment> signals;
    for (std::size_t i = 0; i < definition_.signals.size(); ++i) {
      signals.emplace_back("signals->" + kernel_name(definition_.signals[i].name),
                           lowered_.signals[i]);
    }
    text_.write_function("model_signals",
                         "const ModelPoint* point, const PhaseAt* phase, const real* x, "
                         "ModelSignals* signals",
                         signals, "point phase x");
    return std::move(text_.out);
  }

 private:
  void name_tangents() {
    text_.names[tangent_.scale] = "scale";
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      text_.names[tangent_.tangent[i]] = fmt::format("w[{}]", text_.state_index(i));
      text_.names[tangent_.base[i]] = fmt::format("base[{}]", text_.state_index(i));
    }
    for (std::size_t i = 0; i < tangent_.fields.size(); ++i) {
      text_.names[tangent_.fields[i]] = fmt::format("linear->j{}", i);
    }
    for (std::size_t i = 0; i < tangent_.point.size(); ++i) {
      text_.names[tangent_.point[i]] = fmt::format("point->c{}", lowered_.point.size() + i);
    }
  }

  // Printed from the tree, as all that is of the file: nothing of its text can end the comment.
  void write_heading() {
    text_.out += fmt::format("// {}: written from its equations.\n", definition_.name);
    if (lowered_.coefs.empty()) return;
    text_.out += "// Tabulated over the phase:\n";
    for (std::size_t i = 0; i < lowered_.coefs.size(); ++i) {
      text_.out += fmt::format("//   w{} = {}\n", i,
                               to_short_text(*graph_, lowered_.coef_values[i], formula_->names));
    }
  }

  bool has_contacts() const { return !lowered_.contacts.list.empty(); }

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
    text_.write_list("MODEL_STATES", states);
    if (!parameters.empty()) text_.write_list("MODEL_PARAMETERS", parameters);
    text_.write_list("MODEL_SIGNALS", signals);
    if (!coefs.empty()) text_.write_list("MODEL_PHASE_COEFS", coefs);
    if (!definition_.options.empty()) {
      std::vector<std::string> options;
      for (const OptionInfo& option : definition_.options) {
        options.push_back(kernel_name(option.name) + ", 0, 0");
      }
      text_.write_list("MODEL_OPTIONS", options);
    }
    std::vector<std::string> angles;
    for (std::size_t i = 0; i < definition_.states.size(); ++i) {
      if (definition_.are_angles[i]) angles.push_back(kernel_name(definition_.states[i].name));
    }
    if (!angles.empty()) text_.write_list("MODEL_ANGLES", angles);
    if (definition_.clock) text_.out += "#define MODEL_CLOCKLESS\n";
    if (definition_.second) text_.out += "#define MODEL_CLOCKS 1\n";
    if (lowered_.is_second_order) text_.out += "#define MODEL_SECOND_ORDER\n";
    if (is_rough_) text_.out += "#define MODEL_ROUGH\n";
    if (has_contacts()) write_contact_lists();
    if (!lowered_.surfaces.empty()) write_surface_lists(lowered_, &text_);
    text_.out += "\n#include \"model_types.h\"\n";
  }

  void write_point() {
    text_.out += "\n// What a point needs in the inner loop.\ntypedef struct {\n  real period;\n";
    std::vector<Assignment> assignments;
    const auto add = [&](const std::vector<NodeId>& symbols, const std::vector<NodeId>& values) {
      for (std::size_t i = 0; i < symbols.size(); ++i) {
        text_.out += fmt::format("  real c{};  // {}\n", assignments.size(),
                                 to_short_text(*graph_, values[i], formula_->names));
        assignments.emplace_back(text_.names.at(symbols[i]), values[i]);
      }
    };
    add(lowered_.point, lowered_.point_values);
    add(tangent_.point, tangent_.point_values);
    if (!lowered_.surfaces.empty()) text_.out += "  Sides sides;  // that are held\n";
    text_.out += "} ModelPoint;\n";
    // A period that only counts time is given to the kernels as a number (items.h): a program does
    // not depend on what a study's motions were found to take.
    if (!definition_.clock) {
      assignments.insert(assignments.begin(), {"point->period", formula_->period});
    }
    text_.write_function("model_prepare",
                         "const ModelParameters* p, ModelOptions options, ModelPoint* point",
                         assignments, "p options");
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
    text_.out += fmt::format("#define MODEL_CONTACT\n#define MODEL_CONTACTS {}\n", contacts.size());
    text_.out +=
        fmt::format("#define MODEL_ONE_SIDED(contact) ({})\n", one_sided.empty() ? "0" : one_sided);
    text_.write_list("MODEL_CONTACT_SIGNALS", signals);
    if (lowered_.contacts.has_feedback) text_.out += "#define MODEL_CONTACT_FEEDBACK\n";
    if (lowered_.contacts.direction_varies) text_.out += "#define MODEL_FORCE_DIRECTION_VARIES\n";
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
    text_.write_function("model_contact", at_state + "ModelContact* contacts", seen,
                         "point phase x");
    text_.write_function(
        "model_rhs_in_contact", at_state + "const ModelContact* contacts, real* dx",
        text_.places("dx", contacts.equations),
        penetrations.empty() ? "point phase x contacts" : "point phase x", penetrations);
    text_.out += fmt::format(
        "\nSHARED_FN void model_rhs({}real* dx) {{\n"
        "  ModelContact contacts[MODEL_CONTACTS];\n"
        "  model_contact(point, phase, x, contacts);\n"
        "  model_rhs_in_contact(point, phase, x, contacts, dx);\n}}\n",
        at_state);
    write_directions(at_state);
    text_.write_function("model_force_direction_carried",
                         at_state + "const real* direction, real* dx",
                         text_.places("dx", contacts.carried), "point phase x direction");
    if (contacts.has_feedback) {
      text_.write_function("model_contact_along",
                           at_state + "const real* direction, ModelContact* added", along,
                           "point phase x direction");
    }
  }

  void write_directions(const std::string& at_state) {
    std::vector<std::vector<Assignment>> directions, turned;
    for (const Contact& contact : lowered_.contacts.list) {
      directions.push_back(text_.places("direction", contact.direction));
      turned.push_back(text_.places("out", turned_by_tangent(contact.direction)));
    }
    text_.write_by_contact("model_force_direction", at_state + "real* direction",
                           "point phase x direction", directions);
    if (!lowered_.contacts.direction_varies) return;
    text_.write_by_contact("model_force_direction_tangent", at_state + "const real* w, real* out",
                           "point phase x w out", turned);
  }

  // What a tangent vector w adds to these.
  std::vector<NodeId> turned_by_tangent(const std::vector<NodeId>& values) {
    std::vector<NodeId> w, out;
    for (std::size_t j = 0; j < formula_->states.size(); ++j) {
      w.push_back(graph_->symbol(fmt::format("w[{}]", j)));
      text_.names[w.back()] = fmt::format("w[{}]", text_.state_index(j));
    }
    for (const NodeId value : values)
      out.push_back(derivative_along(graph_, value, formula_->states, w));
    return out;
  }

  void write_linearization() {
    std::vector<Assignment> contact;
    for (std::size_t i = 0; i < lowered_.contacts.list.size(); ++i) {
      contact.emplace_back(fmt::format("added[{}].deflection", i), tangent_.contacts[2 * i]);
      contact.emplace_back(fmt::format("added[{}].backlash", i), tangent_.contacts[2 * i + 1]);
    }
    text_.out += "\n// What the derivative at a state is made of.\ntypedef struct {\n";
    if (tangent_.fields.empty()) text_.out += "  real none;\n";  // a struct must have a member
    std::vector<Assignment> assignments;
    for (std::size_t i = 0; i < tangent_.fields.size(); ++i) {
      text_.out += fmt::format("  real j{};\n", i);
      assignments.emplace_back(fmt::format("linear->j{}", i), tangent_.field_values[i]);
    }
    text_.out += "} ModelLinear;\n";
    text_.write_function(
        "model_linearize",
        "const ModelPoint* point, const PhaseAt* phase, const real* x, real scale, "
        "ModelLinear* linear",
        assignments, "point phase x scale");
    const std::string arguments =
        "const ModelPoint* point, const ModelLinear* linear, const real* w, ";
    text_.out += "\n// out = base + scale J w; out is neither w nor base.";
    text_.write_function("model_tangent", arguments + "const real* base, real* out",
                         text_.places("out", tangent_.rows), "point linear w");
    if (has_contacts()) {
      text_.write_function("model_contact_tangent", arguments + "ModelContact* added", contact,
                           "point linear w");
    }
  }

  const ModelDefinition& definition_;
  Formula* formula_;
  ExpressionGraph* graph_;
  const Lowered& lowered_;
  const bool is_rough_;
  const TangentProgram& tangent_;
  KernelText text_;
};

}  // namespace

std::string kernel_of(const ModelDefinition& definition, Formula* formula, const Lowered& lowered,
                      const TangentProgram& tangent, bool is_rough) {
  return KernelWriter(definition, formula, lowered, tangent, is_rough).text();
}

}  // namespace gearsweep
