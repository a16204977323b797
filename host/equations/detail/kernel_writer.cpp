#include "equations/detail/kernel_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "equations/detail/linearization.hpp"
#include "equations/detail/statements.hpp"

namespace gearsweep {
namespace {

// The first half are positions, the second half their velocities, in the same order.
bool is_second_order(const Formula& formula, const Lowered& lowered) {
  const std::size_t states = formula.states.size();
  if (states % 2 != 0) return false;
  for (std::size_t i = 0; i < states / 2; ++i) {
    if (lowered.equations[i] != formula.states[states / 2 + i]) return false;
  }
  return true;
}

class KernelWriter {
 public:
  KernelWriter(const ModelDefinition& definition, Formula* formula, const Lowered& lowered)
      : definition_(definition), formula_(formula), graph_(&formula->graph), lowered_(lowered) {
    const auto name = [&](const std::vector<NodeId>& symbols) {
      for (const NodeId id : symbols) names_[id] = (*graph_)[id].symbol;
    };
    name(lowered.point);
    name(lowered.coefs);
    name(lowered.direction);
    for (std::size_t i = 0; i < formula->states.size(); ++i) {
      names_[formula->states[i]] = fmt::format("x[STATE_{}]", definition.states[i].name);
    }
    for (std::size_t i = 0; i < formula->parameters.size(); ++i) {
      names_[formula->parameters[i]] = fmt::format("p->{}_", definition.parameters[i].name);
    }
    if (lowered.contact) names_[lowered.contact->penetration] = "penetration";
  }

  std::string text() {
    write_lists();
    write_point();
    if (lowered_.contact) {
      write_contact();
    } else {
      write_function("model_rhs",
                     "const ModelPoint* point, const PhaseCoefs* phase, const real* x, real* dx",
                     places("dx", lowered_.equations), "point phase x");
    }
    write_linearization();
    std::vector<Assignment> signals;
    for (std::size_t i = 0; i < definition_.signals.size(); ++i) {
      signals.emplace_back("signals->" + definition_.signals[i].name, lowered_.signals[i]);
    }
    write_function("model_signals",
                   "const ModelPoint* point, const PhaseCoefs* phase, const real* x, "
                   "ModelSignals* signals",
                   signals, "point phase x");
    return out_;
  }

 private:
  std::vector<Assignment> places(const std::string& array, const std::vector<NodeId>& ids) const {
    std::vector<Assignment> out;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      out.emplace_back(fmt::format("{}[STATE_{}]", array, definition_.states[i].name), ids[i]);
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
    for (const ChannelInfo& state : definition_.states) states.push_back(state.name + ", 0, 0");
    for (const ParameterInfo& parameter : definition_.parameters) {
      parameters.push_back(parameter.name + "_, 0, 0, 0, 0, 0, 0");
    }
    for (const ChannelInfo& signal : definition_.signals) signals.push_back(signal.name + ", 0, 0");
    for (std::size_t i = 0; i < lowered_.coefs.size(); ++i)
      coefs.push_back(fmt::format("w{}, 0", i));
    write_list("MODEL_STATES", states);
    write_list("MODEL_PARAMETERS", parameters);
    write_list("MODEL_SIGNALS", signals);
    if (!coefs.empty()) write_list("MODEL_PHASE_COEFS", coefs);
    std::vector<std::string> angles;
    for (std::size_t i = 0; i < definition_.states.size(); ++i) {
      if (definition_.are_angles[i]) angles.push_back(definition_.states[i].name);
    }
    if (!angles.empty()) write_list("MODEL_ANGLES", angles);
    if (is_second_order(*formula_, lowered_)) out_ += "#define MODEL_SECOND_ORDER\n";
    if (lowered_.contact) out_ += "#define MODEL_CONTACT\n";
    out_ += "\n#include \"model_types.h\"\n";
  }

  void write_point() {
    out_ += "\n// What a point needs in the inner loop.\ntypedef struct {\n  real period;\n";
    std::vector<Assignment> assignments = {{"point->period", formula_->period}};
    for (std::size_t i = 0; i < lowered_.point.size(); ++i) {
      out_ += fmt::format("  real c{};\n", i);
      assignments.emplace_back(names_.at(lowered_.point[i]), lowered_.point_values[i]);
    }
    out_ += "} ModelPoint;\n";
    write_function("model_prepare",
                   "const ModelParameters* p, ModelOptions options, ModelPoint* point", assignments,
                   "p options");
  }

  // A backlash that is never negative takes fewer operations.
  std::string penetration_text() const {
    const std::string begin = "  const real penetration =\n      ";
    if (!lowered_.contact->may_be_negative) {
      return begin +
             "contact->deflection -\n"
             "      lane_clamp(contact->deflection, -contact->backlash, contact->backlash);\n";
    }
    return begin +
           "lane_max(contact->deflection - contact->backlash, (real)(0)) +\n"
           "      lane_min(contact->deflection + contact->backlash, (real)(0));\n";
  }

  void write_contact() {
    const Contact& contact = *lowered_.contact;
    const std::string arguments = "const ModelPoint* point, const PhaseCoefs* phase, ";
    write_function(
        "model_contact", arguments + "const real* x, ModelContact* contact",
        {{"contact->deflection", contact.deflection}, {"contact->backlash", contact.backlash}},
        "point phase x");
    write_function("model_rhs_in_contact",
                   arguments + "const real* x, const ModelContact* contact, real* dx",
                   places("dx", lowered_.in_contact), "point phase x", penetration_text());
    out_ += fmt::format(
        "\nSHARED_FN void model_rhs({}const real* x, real* dx) {{\n"
        "  ModelContact contact;\n"
        "  model_contact(point, phase, x, &contact);\n"
        "  model_rhs_in_contact(point, phase, x, &contact, dx);\n}}\n",
        arguments);
    write_function("model_force_direction", arguments + "real* direction",
                   places("direction", lowered_.force_direction), "point phase");
    write_function("model_force_direction_carried", arguments + "const real* direction, real* dx",
                   places("dx", lowered_.force_direction_carried), "point phase direction");
  }

  // A coefficient that neither states nor the phase change needs no place in ModelLinear.
  bool is_of_point(NodeId id) const {
    const std::vector<NodeId> parts = parts_of(*graph_, {id});
    return std::ranges::none_of(parts, [&](NodeId part) {
      return std::ranges::find(formula_->states, part) != formula_->states.end() ||
             std::ranges::find(lowered_.coefs, part) != lowered_.coefs.end();
    });
  }

  // The coefficient, times the scale if is_scaled, as what the tangent's statements read: a field of
  // ModelLinear, or of the point where that has it already.
  NodeId field(NodeId coefficient, bool is_scaled) {
    const NodeId value =
        is_scaled ? graph_->make(Operation::multiply, {coefficient, scale_}) : coefficient;
    if (!is_scaled && is_of_point(value)) return value;
    const auto known = std::ranges::find(fields_, value);
    const auto index = static_cast<std::size_t>(known - fields_.begin());
    if (known == fields_.end()) {
      fields_.push_back(value);
      field_symbols_.push_back(graph_->symbol(fmt::format("linear->j{}", index)));
      names_[field_symbols_.back()] = fmt::format("linear->j{}", index);
    }
    return field_symbols_[index];
  }

  // base + the terms. A coefficient's sign goes into the sum, so that two that differ in it alone
  // share a field.
  NodeId sum_of(const LinearSum& sum, NodeId base, bool is_scaled,
                const std::vector<NodeId>& tangents) {
    NodeId all = base;
    for (const LinearTerm& term : sum) {
      const Node node = (*graph_)[term.coefficient];
      const bool is_negative = node.operation == Operation::negate ||
                               (node.operation == Operation::number && node.number < 0.0);
      const NodeId size =
          is_negative ? graph_->make(Operation::negate, {term.coefficient}) : term.coefficient;
      const NodeId product =
          graph_->make(Operation::multiply, {field(size, is_scaled), tangents[term.of]});
      all = graph_->make(is_negative ? Operation::subtract : Operation::add, {all, product});
    }
    return all;
  }

  void write_linearization() {
    std::vector<NodeId> outputs = lowered_.equations;
    if (lowered_.contact) {
      outputs.push_back(lowered_.contact->deflection);
      outputs.push_back(lowered_.contact->backlash);
    }
    const Linearization linear = linearize(formula_, outputs);
    scale_ = graph_->symbol("scale");
    names_[scale_] = "scale";

    std::vector<NodeId> tangents;  // of states, then of shared parts
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      tangents.push_back(graph_->symbol(fmt::format("w[{}]", i)));
      names_[tangents.back()] = fmt::format("w[STATE_{}]", definition_.states[i].name);
    }
    const NodeId zero = graph_->number(0.0);
    for (const LinearSum& part : linear.parts) {
      tangents.push_back(sum_of(part, zero, false, tangents));
    }
    std::vector<Assignment> rows, contact;
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      const std::string& name = definition_.states[i].name;
      const NodeId base = graph_->symbol(fmt::format("base[{}]", i));
      names_[base] = fmt::format("base[STATE_{}]", name);
      rows.emplace_back(fmt::format("out[STATE_{}]", name),
                        sum_of(linear.outputs[i], base, true, tangents));
    }
    if (lowered_.contact) {
      const std::size_t states = formula_->states.size();
      contact = {{"added->deflection", sum_of(linear.outputs[states], zero, false, tangents)},
                 {"added->backlash", sum_of(linear.outputs[states + 1], zero, false, tangents)}};
    }

    out_ += "\n// What the derivative at a state is made of.\ntypedef struct {\n";
    if (fields_.empty()) out_ += "  real none;\n";  // a struct must have a member
    std::vector<Assignment> assignments;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      out_ += fmt::format("  real j{};\n", i);
      assignments.emplace_back(fmt::format("linear->j{}", i), fields_[i]);
    }
    out_ += "} ModelLinear;\n";
    write_function("model_linearize",
                   "const ModelPoint* point, const PhaseCoefs* phase, const real* x, real scale, "
                   "ModelLinear* linear",
                   assignments, "point phase x scale");
    const std::string arguments =
        "const ModelPoint* point, const ModelLinear* linear, const real* w, ";
    out_ += "\n// out = base + scale J w; out is neither w nor base.";
    write_function("model_tangent", arguments + "const real* base, real* out", rows,
                   "point linear w");
    if (lowered_.contact) {
      write_function("model_contact_tangent", arguments + "ModelContact* added", contact,
                     "point linear w");
    }
  }

  const ModelDefinition& definition_;
  Formula* formula_;
  ExpressionGraph* graph_;
  const Lowered& lowered_;
  std::map<NodeId, std::string> names_;
  NodeId scale_ = 0;
  std::vector<NodeId> fields_, field_symbols_;  // of ModelLinear
  std::string out_;
};

}  // namespace

std::string kernel_of(const ModelDefinition& definition, Formula* formula, const Lowered& lowered) {
  return KernelWriter(definition, formula, lowered).text();
}

}  // namespace gearsweep
