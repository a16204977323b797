// What the tables of a model's file are made of: entries in their order, expressions with their
// places, lists.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "equations/definition.hpp"

namespace gearsweep {

inline constexpr std::size_t kMaxNames = 64;  // states, choices, entries of a list

struct Entry {
  std::string name;
  const toml::key* key;
  const toml::node* node;
};

// In the order of the file; none where there is no table.
std::vector<Entry> entries_of(const toml::table* table);

// A name that stands in a file at `node`, or, where quote is 1, one character behind its beginning.
ExpressionText place_text(const std::string& text, const toml::node& node, std::size_t quote);

// A number, or an expression in quotes. what: for the message. Throws InputError.
ExpressionText expression_of(const toml::node& node, const std::string& what);

// What gives a parameter by others, as omega = "0.5*wn"; nothing where the node is no text.
std::optional<ExpressionText> derivation_in(const toml::node& node);

// The number that a node is, or a text that says nothing but a number.
std::optional<double> plain_number(const toml::node& node);

// The table of an entry. form: what would be right, for the message. Throws InputError.
const toml::table& table_of(const Entry& entry, const std::string& form);

// a = [1.0, 2.0] and a = { value = [1.0, 2.0], min = 0.0 } stand for a and a_2, which expressions
// call a[1] and a[2]. Null where the entry is no list. Throws InputError.
const toml::array* list_of(const Entry& entry);

}  // namespace gearsweep
