#include "study/detail/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <vector>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "study/nesting.hpp"
#include "study/toml_text.hpp"

namespace gearsweep {
namespace {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

// The value as TOML; a word that is no TOML value is taken as a string.
toml::table parse_value(const std::string& value, const std::string& source) {
  refuse_deep_keys(value, source);
  try {
    return toml::parse("value = " + value, source);
  } catch (const toml::parse_error&) {
    const std::string quoted = "value = " + toml_quoted(value);
    try {
      return toml::parse(quoted, source);
    } catch (const toml::parse_error& error) {
      throw InputError(fmt::format("{}: cannot read the value: {}", source, error.description()));
    }
  }
}

// The element of an array of tables that `part` names: by its `name` key or by its number.
toml::node* find_element(toml::array* array, const std::string& part) {
  for (toml::node& element : *array) {
    const toml::table* table = element.as_table();
    if (table != nullptr && (*table)["name"].value_or(std::string()) == part) return &element;
  }
  const auto index = parse_number<std::size_t>(part);
  return index && *index < array->size() ? array->get(*index) : nullptr;
}

// The node that `part` names in `node`; an empty table is made where a table has no such key.
toml::node* descend(toml::node* node, const std::string& part, const std::string& source) {
  if (toml::array* array = node->as_array()) {
    toml::node* element = find_element(array, part);
    if (element == nullptr) {
      std::vector<std::string> names;
      for (const toml::node& candidate : *array) {
        if (candidate.is_table()) names.push_back((*candidate.as_table())["name"].value_or(""));
      }
      throw InputError(fmt::format("{}: there is no element '{}'{} (or give its number from 0)",
                                   source, part, suggest_name(part, names)));
    }
    return element;
  }
  toml::table* table = node->as_table();
  if (table == nullptr) {
    throw InputError(fmt::format("{}: what stands before '{}' is not a table", source, part));
  }
  if (table->get(part) == nullptr) table->insert(part, toml::table{});
  return table->get(part);
}

// What messages say of an assignment: all of it, unless it is long (the values of an axis).
std::string shown_assignment(const std::string& assignment) {
  constexpr std::size_t kMost = 160;
  if (assignment.size() <= kMost) return assignment;
  std::size_t end = kMost;
  // Not inside a letter of UTF-8.
  while (end > 0 && (static_cast<unsigned char>(assignment[end]) & 0xC0U) == 0x80U) --end;
  return assignment.substr(0, end) + "...";
}

// An axis by its name alone, as in omega.count.
void refuse_bare_axis(const std::vector<std::string>& parts, const toml::table& study,
                      const std::string& source) {
  const toml::array* axes = study["axes"].as_array();
  if (parts.size() < 2 || axes == nullptr || study.contains(parts.front())) return;
  for (const toml::node& axis : *axes) {
    if (!axis.is_table() || (*axis.as_table())["name"].value_or("") != parts.front()) continue;
    throw InputError(
        fmt::format("{}: no such key; did you mean 'axes.{}'?", source, fmt::join(parts, ".")));
  }
}

}  // namespace

void apply_override(const std::string& assignment, toml::table* study) {
  const std::string source = "--set " + shown_assignment(assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("{}: expected PATH=VALUE, as in integrate.record=20", source));
  }
  const std::vector<std::string> parts = split_path(assignment.substr(0, equals));
  if (parts.size() > kMaxParts) {
    throw InputError(fmt::format("{}: a key of more than {} parts", source, kMaxParts));
  }
  refuse_bare_axis(parts, *study, source);
  toml::table parsed = parse_value(assignment.substr(equals + 1), source);
  toml::node* node = study;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) node = descend(node, parts[i], source);
  toml::table* table = node->as_table();
  if (table == nullptr) {
    throw InputError(
        fmt::format("{}: what stands before '{}' is not a table", source, parts.back()));
  }
  // Moved, not copied: a copied node forgets where it came from.
  table->insert_or_assign(parts.back(), std::move(*parsed.get("value")));
}

}  // namespace gearsweep
