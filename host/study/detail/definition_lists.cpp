#include "study/detail/definition_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// Each of the words among the names.
std::vector<MirrorPairs::Pair> read_pairs(const toml::node& node, const std::string& words,
                                          const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const std::string& word : split_words(words)) {
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) {
      fail_at(node, fmt::format("there is no '{}' to mirror{}", word, suggest_name(word, names)));
    }
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  if (places.size() % 2 != 0) {
    fail_at(node, fmt::format("'{}' must name pairs: \"x2 x4\" for x4 = -x2", words));
  }
  std::vector<MirrorPairs::Pair> pairs;
  for (std::size_t i = 0; i < places.size(); i += 2) pairs.push_back({places[i], places[i + 1]});
  return pairs;
}

void need_text(const Entry& entry, const char* what) {
  if (entry.node->is_string()) return;
  fail_at(*entry.node, fmt::format("the {} '{}' needs a text that says what it is of, in quotes",
                                   what, entry.name));
}

}  // namespace

void read_curves(const toml::table* table, ModelNames* names, ModelDefinition* definition) {
  for (const Entry& entry : entries_of(table)) {
    names->take(*entry.node, entry.name);
    need_text(entry, "curve");
    definition->curves.push_back(entry.name);
  }
}

void read_drawing_names(const toml::table* table, ModelDefinition* definition) {
  std::vector<std::string> names = names_of(definition->parameters);
  names.insert(names.end(), definition->curves.begin(), definition->curves.end());
  for (const Entry& entry : entries_of(table)) {
    need_text(entry, "drawing");
    const std::string suffix = "_" + entry.name;
    if (std::ranges::none_of(names,
                             [&](const std::string& one) { return one.ends_with(suffix); })) {
      fail_at(*entry.node, fmt::format("the drawing '{}' gives nothing: no parameter and no curve "
                                       "ends in '{}'",
                                       entry.name, suffix));
    }
    if (entry.name == "tables") fail_at(*entry.node, "a drawing cannot be called 'tables'");
    definition->drawings.push_back(entry.name);
  }
}

namespace {

// e0_first and e0_first_2 are of the drawing `first`.
bool is_of_drawing(std::string parameter, const std::string& drawing) {
  const std::size_t number = parameter.find_last_not_of("0123456789") + 1;
  if (number > 1 && number < parameter.size() && parameter[number - 1] == '_') {
    parameter.resize(number - 1);
  }
  return parameter.ends_with("_" + drawing);
}

}  // namespace

bool is_drawing_unit(const std::string& unit) {
  std::string words = unit;
  std::ranges::replace_if(
      words, [](char c) { return c == '/' || c == '*' || c == '^' || c == '(' || c == ')'; }, ' ');
  return std::ranges::any_of(split_words(words), [](const std::string& word) {
    return word == "b_n" || word == "k0" || word == "varpi" || word == "tau" || word == "cm";
  });
}

void read_unit_drawing(const toml::table& model, ModelDefinition* definition) {
  const std::vector<std::string>& drawings = definition->drawings;
  if (const toml::node* node = model.get("units")) {
    const std::string given = node->value_or(std::string());
    if (std::ranges::find(drawings, given) == drawings.end()) {
      fail_at(*node, fmt::format("units must be the name of one of the [drawings], in quotes{}",
                                 suggest_name(given, drawings)));
    }
    definition->unit_drawing = given;
  } else if (drawings.size() == 1) {
    definition->unit_drawing = drawings.front();
  }
  if (definition->unit_drawing.empty()) return;
  for (std::size_t i = 0; i < definition->parameters.size(); ++i) {
    const ParameterInfo& info = definition->parameters[i];
    for (const std::string& other : drawings) {
      if (other == definition->unit_drawing || !is_of_drawing(info.name, other)) continue;
      const bool has_role = info.role == Role::mesh_damping || info.role == Role::load;
      if (!is_drawing_unit(info.unit) && !has_role) continue;
      const ExpressionText& place = definition->symbols[i];
      if (has_role) {
        throw InputError(fmt::format(
            "{}: '{}' is of the drawing '{}', and the model is in the units of '{}': the role '{}' "
            "is for a parameter of that",
            place.place(), info.name, other, definition->unit_drawing, name_of(info.role)));
      }
      throw InputError(fmt::format(
          "{}: '{}' is in units of the drawing '{}', and '{}' is a unit of '{}': give it one of "
          "its "
          "own, such as unit = \"k0_{} b_n_{}\"",
          place.place(), info.name, other, info.unit, definition->unit_drawing, other, other));
    }
  }
}

void read_checks(const toml::table* table, ModelDefinition* definition) {
  for (const Entry& entry : entries_of(table)) {
    definition->checks.push_back({entry.name, expression_of(*entry.node, "a check")});
  }
}

void read_mirrors(const toml::node* node, ModelDefinition* definition) {
  if (node == nullptr) return;
  const std::string form =
      "mirrors must be a list of tables: mirrors = [{ states = \"x2 x4\", "
      "parameters = \"m1 m2\" }]";
  if (!node->is_array()) fail_at(*node, form);
  for (const toml::node& one : *node->as_array()) {
    if (!one.is_table()) fail_at(one, form);
    TableReader reader(one.as_table(), "a mirror");
    const std::string states = reader.text("states", ""),
                      parameters = reader.text("parameters", "");
    reader.refuse_unknown();
    definition->mirrors.push_back({read_pairs(one, states, names_of(definition->states)),
                                   read_pairs(one, parameters, names_of(definition->parameters))});
  }
}

}  // namespace gearsweep
