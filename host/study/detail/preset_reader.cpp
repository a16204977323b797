#include "study/detail/preset_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/toml_access.hpp"
#include "study/initial_policy.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

// As TOML, where a number without point is an integer.
std::string read_toml_number(const toml::node& node, const std::string& name, double min,
                             double max) {
  const std::string text = fmt::format("{}", read_number(node, name, min, max));
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

// Where it starts, as TOML.
std::string state_values(const toml::table* table, const ModelDefinition& definition) {
  TableReader reader(table, "state");
  std::vector<std::string> values;
  for (const ChannelInfo& info : definition.states) {
    const toml::node* node = reader.find(info.name);
    if (node == nullptr) continue;
    values.push_back(fmt::format("{} = {}", info.name,
                                 read_toml_number(*node, info.name, -kMaxState, kMaxState)));
  }
  reader.refuse_unknown();
  return fmt::format("{}", fmt::join(values, ", "));
}

// What gives a value to each parameter: a list under a plain name is that of NAME, NAME_2, ...
std::map<std::string, const toml::node*> nodes_of_parameters(const toml::table& row,
                                                             const ModelDefinition& definition) {
  std::map<std::string, const toml::node*> nodes;
  const auto add = [&](const std::string& name, const toml::node& node) {
    if (!nodes.emplace(name, &node).second) fail_at(node, fmt::format("{} is given twice", name));
  };
  const std::vector<std::string> names = names_of(definition.parameters);
  for (const std::string& name : names) {
    const toml::node* node = row.get(name);
    const toml::array* list = node == nullptr ? nullptr : node->as_array();
    if (node != nullptr && list == nullptr) add(name, *node);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      const std::string element = name_in_list(name, i);
      if (std::ranges::find(names, element) == names.end()) {
        fail_at(*node, fmt::format("parameter '{}' takes at most {} numbers", name, i));
      }
      add(element, (*list)[i]);
    }
  }
  return nodes;
}

// What it gives to options and parameters, as TOML; expressions apart.
std::string preset_values(const toml::table& row, const ModelDefinition& definition,
                          TableReader* reader, ParameterExpressions* expressions) {
  std::string values;
  for (const OptionInfo& option : definition.options) {
    reader->know(option.name);
    if (!row.contains(option.name)) continue;
    values += fmt::format("{} = '{}'\n", option.name,
                          option.choices[reader->choice(option.name, 0, option.choices)]);
  }
  const std::map<std::string, const toml::node*> nodes = nodes_of_parameters(row, definition);
  for (const ParameterInfo& info : definition.parameters) {
    reader->know(info.name);
    const auto given = nodes.find(info.name);
    if (given == nodes.end()) continue;
    const toml::node& node = *given->second;
    if (std::optional<ExpressionText> derivation = derivation_in(node)) {
      expressions->emplace(info.name, *std::move(derivation));
      continue;
    }
    values +=
        fmt::format("{} = {}\n", info.name, read_toml_number(node, info.name, info.min, info.max));
  }
  return values;
}

}  // namespace

void read_presets(const toml::table* table, ModelDefinition* definition) {
  bool is_first = true;
  for (const Entry& entry : entries_of(table)) {
    const toml::table& row = table_of(entry, "k = 1.0");
    TableReader reader(&row, fmt::format("preset '{}'", entry.name));
    PresetInfo preset{entry.name, reader.text("meaning", ""), "", {}};
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
      preset.toml += fmt::format("state = {{{}}}\n", state_values(state, *definition));
    }
    const std::string values = preset_values(row, *definition, &reader, &preset.expressions);
    reader.refuse_unknown();
    if (is_first && !(values.empty() && preset.expressions.empty())) {
      definition->presets.push_back({"default", "the values of the model's file", ""});
    }
    is_first = false;
    preset.toml += values;
    definition->presets.push_back(std::move(preset));
  }
  if (is_first) {
    definition->presets.push_back({"default", "the values of the model's file", ""});
  }
}

}  // namespace gearsweep
