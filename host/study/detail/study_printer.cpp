#include "study/detail/study_printer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <tuple>
#include <vector>

#include "study/study_keys.hpp"
#include "study/toml_text.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kColumns = 100;

// The TOML library's own printer loses a line end at the beginning, and fails at three quotes.
std::string string_text(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return (code >= ' ' && code != 0x7F) || letter == '\n' || letter == '\t';
  });
  const bool has_lines = text.find('\n') != std::string::npos;
  if (!is_plain || text.find(has_lines ? "'''" : "'") != std::string::npos ||
      text.ends_with('\'')) {
    return toml_quoted(text);
  }
  return has_lines ? "'''\n" + text + "'''" : "'" + text + "'";
}

std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return string_text(text->get());
  std::ostringstream out;
  out << toml::node_view<const toml::node>(node);
  return out.str();
}

bool is_list(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && std::all_of(array->begin(), array->end(),
                                         [](const toml::node& one) { return one.is_value(); });
}

std::string list_text(const toml::array& list, std::size_t column) {
  std::string lines, line;
  const auto end_line = [&] {
    lines += "    " + line + "\n";
    line.clear();
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string element = text_of(list[i]) + (i + 1 < list.size() ? "," : "");
    if (!line.empty() && line.size() + element.size() + 5 > kColumns) end_line();
    line += (line.empty() ? "" : " ") + element;
  }
  if (lines.empty() && column + line.size() + 4 <= kColumns) {
    return line.empty() ? "[]" : fmt::format("[ {} ]", line);
  }
  end_line();
  return "[\n" + lines + "]";
}

std::string quoted_key(const std::string& key) {
  const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '_' || letter == '-';
  });
  return is_bare ? key : toml_quoted(key);
}

// A key and its value.
std::string entry_text(const std::string& key, const toml::node& node) {
  if (is_list(node)) return fmt::format("{} = {}\n", key, list_text(*node.as_array(), key.size()));
  if (node.is_string()) return fmt::format("{} = {}\n", quoted_key(key), text_of(node));
  toml::table alone;
  alone.insert(key, node);
  std::ostringstream out;
  out << alone << '\n';
  return out.str();
}

struct PrintedKey {
  std::string name;
  const toml::node* node;
};

// In the order of the declaration; names of the model where it has a pattern for them.
std::vector<PrintedKey> ordered(const toml::table& table, const StudyTable* declared) {
  const auto place_of_key = [&](const std::string& name) {
    if (declared == nullptr) return std::ptrdiff_t{0};
    const auto& keys = declared->keys;
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const StudyKey& key) {
      return key.is_pattern || key.name == name;
    });
    return found - keys.begin();
  };
  const auto is_long = [](const PrintedKey& key) {
    return key.node->is_string() && key.node->as_string()->get().find('\n') != std::string::npos;
  };
  std::vector<PrintedKey> keys;
  for (const auto& [key, node] : table) keys.push_back({std::string(key.str()), &node});
  const auto rank = [&](const PrintedKey& key) {
    return std::tuple(is_long(key), place_of_key(key.name), key.name);
  };
  std::sort(keys.begin(), keys.end(),
            [&](const PrintedKey& a, const PrintedKey& b) { return rank(a) < rank(b); });
  return keys;
}

// A table's own keys first, then the tables in it.
void print_table(const toml::table& table, const StudyTable* declared, const std::string& path,
                 const std::string& heading, std::string* out) {
  *out += heading;
  const std::vector<PrintedKey> keys = ordered(table, declared);
  for (const auto& [name, node] : keys) {
    if (!node->is_table() && !node->is_array_of_tables()) *out += entry_text(name, *node);
  }
  for (const auto& [name, node] : keys) {
    if (!node->is_table() && !node->is_array_of_tables()) continue;
    const std::string own = path.empty() ? name : fmt::format("{}.{}", path, name);
    const StudyTable* inner = path.empty() ? &study_table(name) : nullptr;
    if (const toml::table* table_inside = node->as_table()) {
      const std::string space = out->empty() ? "" : "\n";
      print_table(*table_inside, inner, own, fmt::format("{}[{}]\n", space, own), out);
      continue;
    }
    for (const toml::node& element : *node->as_array()) {
      const std::string space = out->empty() ? "" : "\n";
      print_table(*element.as_table(), inner, own, fmt::format("{}[[{}]]\n", space, own), out);
    }
  }
}

}  // namespace

std::string print_study(const toml::table& study) {
  std::string text;
  print_table(study, &study_table(""), "", "", &text);
  return text;
}

}  // namespace gearsweep
