#include "study/detail/definition_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/model_names.hpp"
#include "study/detail/toml_access.hpp"
#include "study/initial_policy.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr double kLargest = 1e12;      // of a parameter that names no range
constexpr std::size_t kMaxNames = 64;  // states; parameters may be more

class DefinitionReader {
 public:
  DefinitionReader(const toml::table& root, std::string text, std::string source)
      : root_(root), source_(std::move(source)) {
    definition_.text = std::move(text);
  }

  ModelDefinition run() {
    TableReader reader(&root_, "the model's file");
    read_model(required(&reader, "model"));
    read_states(required(&reader, "states"));
    read_limits(*reader.table("model"));
    read_parameters(reader.table("parameters"));
    read_options(reader.table("options"));
    read_constants(reader.table("constants"));
    read_equations(required(&reader, "equations"));
    read_forcing(required(&reader, "forcing"));
    read_signals(reader.table("signals"));
    read_presets(reader.table("presets"));
    reader.refuse_unknown();
    return std::move(definition_);
  }

 private:
  struct Entry {
    std::string name;
    const toml::key* key;
    const toml::node* node;
  };

  const toml::table* required(TableReader* reader, const std::string& name) const {
    const toml::table* table = reader->table(name);
    if (table == nullptr) {
      throw InputError(fmt::format("{}: the model has no [{}]", source_, name));
    }
    return table;
  }

  // In the order of the file.
  static std::vector<Entry> entries_of(const toml::table* table) {
    std::vector<Entry> entries;
    if (table == nullptr) return entries;
    for (const auto& [key, node] : *table) {
      entries.push_back({std::string(key.str()), &key, &node});
    }
    const auto place = [](const Entry& entry) {
      const toml::source_position begin = entry.key->source().begin;
      return std::pair(begin.line, begin.column);
    };
    std::ranges::sort(entries, {}, place);
    return entries;
  }

  ExpressionText expression_of(const toml::node& node, const std::string& what) const {
    if (node.is_number()) {
      std::ostringstream text;
      text << toml::node_view<const toml::node>(node);
      return place_text(text.str(), node, 0);
    }
    if (!node.is_string()) {
      fail_at(node, fmt::format("{} must be an expression in quotes", what));
    }
    return place_text(node.as_string()->get(), node, 1);
  }
  static ExpressionText place_text(const std::string& text, const toml::node& node,
                                   std::size_t quote) {
    const toml::source_region& region = node.source();
    return {.text = text,
            .file = region.path ? *region.path : std::string("model"),
            .line = region.begin.line,
            .column = region.begin.column + quote};
  }

  // The table of an entry, or nullptr where something shorter stands for it.
  static const toml::table& table_of(const Entry& entry, const std::string& form) {
    if (!entry.node->is_table()) {
      fail_at(*entry.node,
              fmt::format("'{}' must be a table: {} = {{ {} }}", entry.name, entry.name, form));
    }
    return *entry.node->as_table();
  }

  void read_model(const toml::table* table) {
    TableReader reader(table, "[model]");
    definition_.name = reader.text("name", "");
    if (!is_model_name(definition_.name)) {
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
    reader.know("diverged_above");  // read_limits(), once the states are known
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

  void read_parameters(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      ParameterInfo info;
      info.name = entry.name;
      if (entry.node->is_number()) {
        names_.take(*entry.node, entry.name);
        info.unit = "1";
        info.default_value = read_number(*entry.node, entry.name, -kLargest, kLargest);
        info.min = -kLargest;
        info.max = kLargest;
        info.meaning = entry.name;
        definition_.symbols.push_back(place_text(entry.name, *entry.node, 0));
      } else {
        read_parameter(entry, &info);
      }
      definition_.parameters.push_back(std::move(info));
    }
    if (definition_.parameters.empty()) {
      throw InputError(
          fmt::format("{}: the model has no [parameters]: nothing could be swept", source_));
    }
  }

  void read_parameter(const Entry& entry, ParameterInfo* info) {
    const toml::table& row = table_of(entry, "value = 1.0, min = 0.0, max = 10.0");
    TableReader reader(&row, fmt::format("parameter '{}'", entry.name));
    std::string symbol = entry.name;
    if (const toml::node* as = reader.find("as")) {
      symbol = reader.text("as", "");
      names_.take_outside(row, entry.name);
      names_.take(*as, symbol);
    } else {
      names_.take(*entry.node, entry.name);
    }
    definition_.symbols.push_back(place_text(symbol, row, 0));
    info->unit = reader.text("unit", "1");
    info->min = reader.number("min", -kLargest, -kLargest, kLargest);
    info->max = reader.number("max", kLargest, info->min, kLargest);
    if (reader.find("value") == nullptr) {
      fail_at(row, fmt::format("parameter '{}' has no value", entry.name));
    }
    info->default_value = reader.number("value", 0.0, info->min, info->max);
    info->meaning = reader.text("meaning", entry.name);
    info->role = read_role(&reader, roles_of_parameters());
    const auto is_same = [&](const ParameterInfo& other) { return other.role == info->role; };
    if (info->role != Role::none && std::ranges::any_of(definition_.parameters, is_same)) {
      fail_at(*row.get("role"), fmt::format("a model has one parameter of the role '{}'; '{}' is a "
                                            "second one",
                                            name_of(info->role), entry.name));
    }
    reader.refuse_unknown();
  }

  static Role read_role(TableReader* reader, const std::vector<Role>& known) {
    std::vector<std::string> names;
    for (const Role role : known) names.push_back(name_of(role));
    if (reader->find("role") == nullptr) return Role::none;
    return known[reader->choice("role", 0, names)];
  }

  void read_options(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take(*entry.node, entry.name);
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

  void read_constants(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      names_.take(*entry.node, entry.name);
      definition_.constants.push_back({entry.name, expression_of(*entry.node, entry.name)});
    }
  }

  void read_equations(const toml::table* table) {
    std::vector<std::string> states;
    for (const ChannelInfo& state : definition_.states) {
      states.push_back(state.name);
      const toml::node* node = table->get(state.name);
      if (node == nullptr) {
        fail_at(*table, fmt::format("state '{}' has no equation", state.name));
      }
      definition_.equations.push_back(
          expression_of(*node, fmt::format("the derivative of {}", state.name)));
    }
    for (const Entry& entry : entries_of(table)) {
      if (std::ranges::find(states, entry.name) != states.end()) continue;
      fail_at(*entry.node,
              fmt::format("'{}' is not a state{}", entry.name, suggest_name(entry.name, states)));
    }
  }

  void read_forcing(const toml::table* table) {
    TableReader reader(table, "[forcing]");
    const toml::node* period = reader.find("period");
    if (period == nullptr) {
      fail_at(*table,
              "[forcing] needs the period: period = \"2*pi/omega\" (of a model without "
              "forcing the time from section to section)");
    }
    definition_.period = expression_of(*period, "period");
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
        reader.refuse_unknown();
      }
      definition_.signals.push_back(std::move(info));
    }
  }

  // The values of the file are a preset, too: the first one of the file, if that changes nothing.
  void read_presets(const toml::table* table) {
    bool is_first = true;
    for (const Entry& entry : entries_of(table)) {
      const toml::table& row = table_of(entry, "k = 1.0");
      TableReader reader(&row, fmt::format("preset '{}'", entry.name));
      PresetInfo preset{entry.name, reader.text("meaning", ""), ""};
      if (reader.find("policy") != nullptr) {
        const std::size_t policy = reader.choice("policy", 0, policy_names());
        preset.toml += fmt::format("policy = '{}'\n", policy_names()[policy]);
      }
      if (const toml::table* state = reader.table("state")) {
        const auto fixed = fmt::format("policy = '{}'\n", info_of(InitialPolicy::fixed).name);
        if (reader.find("policy") == nullptr) preset.toml += fixed;
        if (!preset.toml.ends_with(fixed)) {
          fail_at(*state,
                  fmt::format("preset '{}' has a state, so its policy is 'fixed'", preset.name));
        }
        preset.toml += fmt::format("state = {{{}}}\n", state_values(state));
      }
      const std::string values = preset_values(row, &reader);
      reader.refuse_unknown();
      if (is_first && !values.empty()) {
        definition_.presets.push_back({"default", "the values of the model's file", ""});
      }
      is_first = false;
      preset.toml += values;
      definition_.presets.push_back(std::move(preset));
    }
    if (is_first) {
      definition_.presets.push_back({"default", "the values of the model's file", ""});
    }
  }

  // Where it starts, as TOML.
  std::string state_values(const toml::table* table) const {
    TableReader reader(table, "state");
    std::vector<std::string> values;
    for (const ChannelInfo& info : definition_.states) {
      const toml::node* node = reader.find(info.name);
      if (node == nullptr) continue;
      values.push_back(fmt::format("{} = {}", info.name,
                                   read_toml_number(*node, info.name, -kMaxState, kMaxState)));
    }
    reader.refuse_unknown();
    return fmt::format("{}", fmt::join(values, ", "));
  }

  // What it gives to options and parameters, as TOML.
  std::string preset_values(const toml::table& row, TableReader* reader) const {
    std::string values;
    for (const OptionInfo& option : definition_.options) {
      reader->know(option.name);
      if (!row.contains(option.name)) continue;
      values += fmt::format("{} = '{}'\n", option.name,
                            option.choices[reader->choice(option.name, 0, option.choices)]);
    }
    for (const ParameterInfo& info : definition_.parameters) {
      reader->know(info.name);
      const toml::node* node = row.get(info.name);
      if (node == nullptr) continue;
      values += fmt::format("{} = {}\n", info.name,
                            read_toml_number(*node, info.name, info.min, info.max));
    }
    return values;
  }

  // As TOML, where a number without point is an integer.
  static std::string read_toml_number(const toml::node& node, const std::string& name, double min,
                                      double max) {
    const std::string text = fmt::format("{}", read_number(node, name, min, max));
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  }

  const toml::table& root_;
  const std::string source_;
  ModelDefinition definition_;
  ModelNames names_;
};

}  // namespace

ModelDefinition read_definition(const toml::table& root, const std::string& text,
                                const std::string& source) {
  return DefinitionReader(root, text, source).run();
}

}  // namespace gearsweep
