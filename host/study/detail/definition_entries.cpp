#include "study/detail/definition_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "study/detail/number_lines.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {

std::vector<Entry> entries_of(const toml::table* table) {
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

ExpressionText place_text(const std::string& text, const toml::node& node, std::size_t quote) {
  const toml::source_region& region = node.source();
  return {.text = text,
          .file = region.path ? *region.path : std::string("model"),
          .line = region.begin.line,
          .column = region.begin.column + quote};
}

ExpressionText expression_of(const toml::node& node, const std::string& what) {
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

std::optional<ExpressionText> derivation_in(const toml::node& node) {
  if (!node.is_string()) return std::nullopt;
  ExpressionText out = expression_of(node, "");
  // Elsewhere it stands in one line.
  std::ranges::replace_if(
      out.text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  // A value that an option gave has no line.
  if (out.file.starts_with("--")) out.line = 0;
  return out;
}

std::optional<double> plain_number(const toml::node& node) {
  const std::optional<double> number =
      node.is_string() ? number_in(node.as_string()->get()) : node.value<double>();
  return number && std::isfinite(*number) ? number : std::nullopt;
}

const toml::table& table_of(const Entry& entry, const std::string& form) {
  if (!entry.node->is_table()) {
    fail_at(*entry.node,
            fmt::format("'{}' must be a table: {} = {{ {} }}", entry.name, entry.name, form));
  }
  return *entry.node->as_table();
}

const toml::array* list_of(const Entry& entry) {
  const toml::table* row = entry.node->as_table();
  const toml::node* values = row == nullptr ? entry.node : row->get("value");
  const toml::array* list = values == nullptr ? nullptr : values->as_array();
  if (list != nullptr && (list->empty() || list->size() > kMaxNames)) {
    fail_at(*values, fmt::format("a list has 1 to {} values", kMaxNames));
  }
  return list;
}

}  // namespace gearsweep
