#include "study/detail/toml_access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/error.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

std::string describe(const toml::node& node) {
  std::ostringstream out;
  out << node.type();
  return out.str();
}

// In UTF-8 every byte but those that continue a character begins one.
std::ptrdiff_t characters_of(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

}  // namespace

std::string place_of(const toml::node& node) {
  const toml::source_region& region = node.source();
  // Tables that an override made on its way have no place of their own.
  const std::string path = region.path ? *region.path : std::string("--set");
  if (path.starts_with("--")) return path;
  return fmt::format("{}:{}", path, region.begin.line);
}

void fail_at(const toml::node& node, const std::string& message) {
  throw InputError(fmt::format("{}: {}", place_of(node), message));
}

std::optional<std::int64_t> whole_value(const toml::node& node) {
  if (node.is_integer()) return node.as_integer()->get();
  if (!node.is_floating_point()) return std::nullopt;
  constexpr double kExact = 9007199254740992.0;  // 2^53: up to here each whole number has its own
  const double value = node.as_floating_point()->get();
  const bool is_whole = std::abs(value) <= kExact && value == std::floor(value);
  return is_whole ? std::optional(static_cast<std::int64_t>(value)) : std::nullopt;
}

double read_number(const toml::node& node, const std::string& what, double min, double max) {
  if (!node.is_number()) {
    fail_at(node, fmt::format("{} must be a number, not {}", what, describe(node)));
  }
  // The parser itself gives no integer as a number that has not exactly its value.
  const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                         : node.as_floating_point()->get();
  if (!std::isfinite(value)) {
    fail_at(node, fmt::format("{} must be finite, not {}", what, value));
  }
  if (value < min || value > max) {
    fail_at(node, fmt::format("{} = {} is out of range; from {} to {} is allowed", what, value, min,
                              max));
  }
  return value;
}

std::vector<double> read_by_state(const toml::node& node, const std::string& what,
                                  const std::vector<std::string>& states,
                                  std::vector<double> otherwise, double min, double max) {
  if (!node.is_table()) {
    otherwise.assign(states.size(), read_number(node, what, min, max));
    return otherwise;
  }
  TableReader reader(node.as_table(), what);
  for (std::size_t i = 0; i < states.size(); ++i) {
    reader.know(states[i]);
    const toml::node* own = node.as_table()->get(states[i]);
    if (own != nullptr) otherwise[i] = read_number(*own, states[i], min, max);
  }
  reader.refuse_unknown();
  return otherwise;
}

TableReader::TableReader(const toml::table* table, const StudyTable& declared)
    : table_(table), declared_(&declared), name_(declared.heading) {
  for (const StudyKey& key : declared.keys) {
    if (!key.is_pattern) know(key.name);
  }
}

TableReader::TableReader(const toml::table* table, std::string name)
    : table_(table), name_(std::move(name)) {}

const StudyKey& TableReader::declared(const std::string& key) const {
  const StudyKey* found = declared_ == nullptr ? nullptr : find_key(*declared_, key);
  if (found == nullptr) throw std::logic_error(name_ + " declares no key " + key);
  return *found;
}

const toml::node* TableReader::find(const std::string& key) {
  know(key);
  return table_ == nullptr ? nullptr : table_->get(key);
}

const toml::table* TableReader::table(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) fail_at(*node, fmt::format("'{}' must be a table: [{}]", key, key));
  return node->as_table();
}

double TableReader::number(const std::string& key, double fallback) {
  const StudyKey& range = declared(key);
  return number(key, fallback, range.min, range.max);
}

double TableReader::number(const std::string& key, double fallback, double min, double max) {
  return optional_number(key, min, max).value_or(fallback);
}

std::optional<double> TableReader::optional_number(const std::string& key, double min, double max) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return read_number(*node, key, min, max);
}

std::size_t TableReader::count(const std::string& key, std::size_t fallback) {
  const StudyKey& range = declared(key);
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!whole_value(*node)) {
    fail_at(*node, fmt::format("{} must be a whole number, not {}", key, describe(*node)));
  }
  return static_cast<std::size_t>(read_number(*node, key, range.min, range.max));
}

bool TableReader::boolean(const std::string& key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) fail_at(*node, fmt::format("{} must be true or false", key));
  return node->as_boolean()->get();
}

std::string TableReader::text(const std::string& key, const std::string& fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_string()) {
    fail_at(*node, fmt::format("{} must be a string in quotes, not {}", key, describe(*node)));
  }
  const std::string& value = node->as_string()->get();
  const StudyKey* limits = declared_ == nullptr ? nullptr : find_key(*declared_, key);
  const double most = limits == nullptr ? 0.0 : limits->max;
  const auto length = static_cast<double>(characters_of(value));
  if (most > 0.0 && length > most) {
    fail_at(*node, fmt::format("{} has {} characters; at most {} are possible", key, length, most));
  }
  return value;
}

std::size_t TableReader::choice(const std::string& key, std::size_t fallback) {
  return choice(key, fallback, declared(key).choices);
}

std::size_t TableReader::choice(const std::string& key, std::size_t fallback,
                                const std::vector<std::string>& choices) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const std::string value = text(key, "");
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found == choices.end()) {
    fail_at(*node, fmt::format("unknown {} '{}'{}", key, value, suggest_name(value, choices)));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) {
    fail_at(*node, fmt::format("{} must be a list of strings: {} = [\"...\", \"...\"]", key, key));
  }
  std::vector<std::string> out;
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_string()) {
      fail_at(element, fmt::format("{} must hold strings only", key));
    }
    out.push_back(element.as_string()->get());
  }
  return out;
}

std::vector<double> TableReader::numbers(const std::string& key, double min, double max) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) return {read_number(*node, key, min, max)};
  std::vector<double> out;
  for (const toml::node& element : *node->as_array()) {
    out.push_back(read_number(element, key, min, max));
  }
  return out;
}

void TableReader::know(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

void TableReader::refuse_unknown() const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
      fail_at(node,
              fmt::format("unknown key '{}' in {}{}", name, name_, suggest_name(name, known_)));
    }
  }
}

}  // namespace gearsweep
