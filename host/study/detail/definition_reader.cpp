#include "study/detail/definition_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/definition_lists.hpp"
#include "study/detail/model_names.hpp"
#include "study/detail/parameter_reader.hpp"
#include "study/detail/preset_reader.hpp"
#include "study/detail/section_reader.hpp"
#include "study/detail/toml_access.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr const char* kSecondPhase = "phase2";

class DefinitionReader {
 public:
  DefinitionReader(const toml::table& root, std::string text, std::string source,
                   const std::set<std::string>& promoted)
      : root_(root), source_(std::move(source)), promoted_(promoted) {
    definition_.text = std::move(text);
  }

  ModelDefinition run() {
    TableReader reader(&root_, "the model's file");
    read_model(required(&reader, "model"));
    read_states(required(&reader, "states"));
    read_second(reader.table("forcing"));
    read_limits(*reader.table("model"));
    read_parameters(reader.table("parameters"), &names_, &definition_);
    read_options(reader.table("options"));
    read_curves(reader.table("curves"), &names_, &definition_);
    read_drawing_names(reader.table("drawings"), &definition_);
    read_unit_drawing(*root_["model"].as_table(), &definition_);
    read_functions(reader.table("functions"));
    read_constants(reader.table("constants"));
    read_equations(required(&reader, "equations"));
    read_forcing(reader.table("forcing"));
    read_signals(reader.table("signals"));
    read_surfaces(reader.table("surfaces"));
    definition_.sections = read_sections(reader.table("sections"));
    read_presets(reader.table("presets"), &definition_);
    read_checks(reader.table("checks"), &definition_);
    read_mirrors(root_["model"].as_table()->get("mirrors"), &definition_);
    reader.know("answers");  // once the model is made: read_answers()
    reader.refuse_unknown();
    return std::move(definition_);
  }

 private:
  const toml::table* required(TableReader* reader, const std::string& name) const {
    const toml::table* table = reader->table(name);
    if (table == nullptr) {
      throw InputError(fmt::format("{}: the model has no [{}]", source_, name));
    }
    return table;
  }

  void read_model(const toml::table* table) {
    TableReader reader(table, "[model]");
    definition_.name = reader.text("name", "");
    if (!is_model_name(definition_.name)) {
      if (table->contains("text") || table->contains("file")) {
        fail_at(*table,
                "this [model] is that of a study: 'gearsweep model --study FILE' shows its model");
      }
      fail_at(*table, fmt::format("[model] needs a name of up to {} letters, digits and _: "
                                  "name = \"impact\"",
                                  kMaxModelNameLetters));
    }
    definition_.summary = reader.text("summary", "");
    const std::string source = reader.text("source", "");
    if (!source.empty()) {
      definition_.summary += fmt::format("{}({})", definition_.summary.empty() ? "" : " ", source);
    }
    definition_.max_step =
        reader.number("max_step", definition_.max_step, kMinMaxStep, kMaxMaxStep);
    definition_.assumptions = reader.texts("assumptions");
    // Once the states are known: read_limits(), read_mirrors().
    reader.know("diverged_above");
    reader.know("mirrors");
    reader.know("units");  // read_unit_drawing()
    reader.refuse_unknown();
  }

  void read_limits(const toml::table& model) {
    std::vector<std::string> states;
    for (const ChannelInfo& state : definition_.states) states.push_back(state.name);
    definition_.diverged_above.assign(states.size(), std::numeric_limits<double>::infinity());
    const toml::node* node = model.get("diverged_above");
    if (node == nullptr) return;
    definition_.diverged_above = read_by_state(
        *node, "diverged_above", states, definition_.diverged_above, 1.0 / kMaxState, kMaxState);
  }

  void read_states(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take(*entry.node, entry.name);
      const toml::table& row = table_of(entry, "unit = \"1\", meaning = \"position\"");
      TableReader reader(&row, fmt::format("state '{}'", entry.name));
      definition_.states.push_back(
          {entry.name, reader.text("unit", "1"), reader.text("meaning", entry.name)});
      const toml::node* start = reader.find("start");
      definition_.start.push_back(start == nullptr ? ExpressionText{"0", source_, 0, 0}
                                                   : expression_of(*start, "start"));
      const toml::node* angle = reader.find("angle");
      if (angle != nullptr && !angle->is_boolean()) fail_at(*angle, "angle must be true or false");
      definition_.are_angles.push_back(angle != nullptr && angle->as_boolean()->get());
      definition_.groups.push_back(reader.text("group", ""));
      reader.refuse_unknown();
    }
    if (definition_.states.empty() || definition_.states.size() > kMaxNames) {
      fail_at(*table, fmt::format("a model has 1 to {} states, not {}", kMaxNames,
                                  definition_.states.size()));
    }
  }

  // The phase of a second frequency is a state behind all others.
  void read_second(const toml::table* forcing) {
    const toml::node* second = forcing == nullptr ? nullptr : forcing->get("second");
    if (second == nullptr) return;
    names_.take(*second, kSecondPhase);
    definition_.second = expression_of(*second, "second");
    definition_.states.push_back({kSecondPhase, "rad", "phase of the second frequency"});
    definition_.start.push_back({"0", source_, 0, 0});
    definition_.are_angles.push_back(true);
    definition_.groups.emplace_back();
  }

  bool is_second_phase(const std::string& state) const {
    return definition_.second && state == kSecondPhase;
  }

  // The parameter that a force between teeth is divided by in its load factor.
  std::string read_load(const ChannelInfo& force, TableReader* reader) const {
    const toml::node* node = reader->find("load");
    if (node == nullptr) return "";
    std::string load = reader->text("load", "");
    if (force.role != Role::mesh_force) {
      fail_at(*node,
              fmt::format("signal '{}' has a load, and not the role \"mesh_force\"", force.name));
    }
    const auto known = std::ranges::find(definition_.parameters, load, &ParameterInfo::name);
    if (known == definition_.parameters.end()) {
      fail_at(*node,
              fmt::format("the load of signal '{}' must be a parameter of the model, not '{}'",
                          force.name, load));
    }
    return load;
  }

  void read_options(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take_outside(*entry.node, entry.name);
      const toml::table& row = table_of(entry, "choices = [\"a\", \"b\"]");
      TableReader reader(&row, fmt::format("option '{}'", entry.name));
      const OptionInfo info{entry.name, reader.texts("choices"),
                            reader.text("meaning", entry.name)};
      reader.refuse_unknown();
      const std::set<std::string> different(info.choices.begin(), info.choices.end());
      if (info.choices.size() < 2 || info.choices.size() > kMaxNames ||
          different.size() != info.choices.size() ||
          !std::ranges::all_of(info.choices, is_model_name)) {
        fail_at(row, fmt::format("option '{}' needs from 2 to {} different names as choices, the "
                                 "default first: choices = [\"a\", \"b\"]",
                                 entry.name, kMaxNames));
      }
      definition_.options.push_back(info);
    }
  }

  static std::string without_spaces_around(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
  }

  void read_functions(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      const std::size_t open = entry.name.find('('), close = entry.name.rfind(')');
      if (open == std::string::npos || close != entry.name.size() - 1) {
        fail_at(*entry.node, fmt::format("'{}' must name its arguments, in quotes: "
                                         "\"hertz(p)\" = \"max(p, 0)^1.5\"",
                                         entry.name));
      }
      NamedFunction function{without_spaces_around(entry.name.substr(0, open)),
                             {},
                             expression_of(*entry.node, entry.name)};
      names_.take(*entry.node, function.name);
      ModelNames own;
      for (const std::string& text : split(entry.name.substr(open + 1, close - open - 1), ',')) {
        function.arguments.push_back(without_spaces_around(text));
        own.take(*entry.node, function.arguments.back());
      }
      definition_.functions.push_back(std::move(function));
    }
  }

  void read_constants(const toml::table* table) {
    const auto add = [this](const toml::node& node, const std::string& name) {
      const std::optional<double> number = plain_number(node);
      if (number && promoted_.contains(name)) {
        add_constant_parameter(node, name, &names_, &definition_);
        definition_.parameters.back().default_value = *number;
        definition_.expressions.erase(name);  // what a number in quotes looks like
        return;
      }
      names_.take(node, name);
      definition_.constants.push_back({name, expression_of(node, name)});
      definition_.constant_infos.push_back({name, number});
    };
    for (const Entry& entry : entries_of(table)) {
      const toml::array* list = list_of(entry);
      if (list == nullptr) add(*entry.node, entry.name);
      for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
        add((*list)[i], name_in_list(entry.name, i));
      }
    }
  }

  void read_equations(const toml::table* table) {
    std::vector<std::string> states;
    for (const ChannelInfo& state : definition_.states) {
      if (is_second_phase(state.name)) continue;
      states.push_back(state.name);
      const toml::node* node = table->get(state.name);
      if (node == nullptr) {
        fail_at(*table, fmt::format("state '{}' has no equation", state.name));
      }
      definition_.equations.push_back(
          expression_of(*node, fmt::format("the derivative of {}", state.name)));
    }
    if (definition_.second) definition_.equations.push_back(*definition_.second);
    for (const Entry& entry : entries_of(table)) {
      if (std::ranges::find(states, entry.name) != states.end()) continue;
      fail_at(*entry.node,
              fmt::format("'{}' is not a state{}", entry.name, suggest_name(entry.name, states)));
    }
  }

  void read_forcing(const toml::table* table) {
    if (table == nullptr) {
      definition_.clock = 1.0;
      definition_.period = {"1", source_, 0, 0};
      return;
    }
    TableReader reader(table, "[forcing]");
    const toml::node* period = reader.find("period");
    if (period == nullptr) {
      fail_at(*table,
              "[forcing] needs the period: period = \"2*pi/omega\"; a model without forcing needs "
              "no [forcing]");
    }
    definition_.period = expression_of(*period, "period");
    reader.know("second");  // read_second()
    if (const toml::node* cycle = reader.find("cycle")) {
      names_.take(*cycle, "turn");
      definition_.cycle = expression_of(*cycle, "cycle");
    }
    if (const toml::node* jumps = reader.find("jumps")) {
      if (!jumps->is_array()) {
        fail_at(*jumps, "jumps must be a list of phases in radians: jumps = [\"2*pi*duty\"]");
      }
      for (const toml::node& jump : *jumps->as_array()) {
        definition_.jumps.push_back(expression_of(jump, "a jump"));
      }
    }
    reader.refuse_unknown();
  }

  void read_signals(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take(*entry.node, entry.name);
      ChannelInfo info{entry.name, "1", entry.name};
      if (entry.node->is_string()) {
        definition_.signal_values.push_back(expression_of(*entry.node, entry.name));
      } else {
        const toml::table& row = table_of(entry, "expression = \"k*x\", unit = \"1\"");
        TableReader reader(&row, fmt::format("signal '{}'", entry.name));
        const toml::node* value = reader.find("expression");
        if (value == nullptr) {
          fail_at(row, fmt::format("signal '{}' has no expression", entry.name));
        }
        definition_.signal_values.push_back(expression_of(*value, entry.name));
        info.unit = reader.text("unit", "1");
        info.meaning = reader.text("meaning", entry.name);
        info.role = read_role(&reader, roles_of_signals());
        info.load = read_load(info, &reader);
        reader.refuse_unknown();
      }
      definition_.signals.push_back(std::move(info));
    }
  }

  void read_surfaces(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take(*entry.node, entry.name);
      const toml::table& row = table_of(entry, "when = \"x - gap\", reset = { v = \"-r*v\" }");
      TableReader reader(&row, fmt::format("surface '{}'", entry.name));
      const toml::node* when = reader.find("when");
      if (when == nullptr) {
        fail_at(row,
                fmt::format("surface '{}' says not where it is: when = \"x - gap\"", entry.name));
      }
      SurfaceDefinition surface{entry.name, expression_of(*when, "when"), {}};
      const toml::table* reset = reader.table("reset");
      if (reset == nullptr || reset->empty()) {
        fail_at(row, fmt::format("surface '{}' says not what happens at it: reset = {{ v = "
                                 "\"-r*v\" }}; jumps of the equations, as of sign(v - belt), are "
                                 "found without it, and a motion sticks to them",
                                 entry.name));
      }
      std::vector<std::string> states;
      for (const ChannelInfo& state : definition_.states) {
        const bool may_jump = !is_second_phase(state.name);
        if (may_jump) states.push_back(state.name);
        const toml::node* to = may_jump ? reset->get(state.name) : nullptr;
        surface.reset.push_back(
            to == nullptr ? ExpressionText{state.name, source_, 0, 0}
                          : expression_of(*to, fmt::format("the reset of {}", state.name)));
      }
      for (const Entry& to : entries_of(reset)) {
        if (std::ranges::find(states, to.name) != states.end()) continue;
        fail_at(*to.node,
                fmt::format("'{}' is not a state{}", to.name, suggest_name(to.name, states)));
      }
      reader.refuse_unknown();
      definition_.surfaces.push_back(std::move(surface));
    }
  }

  const toml::table& root_;
  const std::string source_;
  const std::set<std::string>& promoted_;
  ModelDefinition definition_;
  ModelNames names_;
};

}  // namespace

ModelDefinition read_definition(const toml::table& root, const std::string& text,
                                const std::string& source, const std::set<std::string>& promoted) {
  return DefinitionReader(root, text, source, promoted).run();
}

}  // namespace gearsweep
