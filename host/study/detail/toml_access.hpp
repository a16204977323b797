// Reading TOML with messages that name the place, what is wrong and what would be right.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/study_keys.hpp"

namespace gearsweep {

// "study.toml:14"; for a value that an option gave, "--set a.b=v".
std::string place_of(const toml::node& node);

// Throws InputError "place: message".
[[noreturn]] void fail_at(const toml::node& node, const std::string& message);

// An integer, or a float that is one: TOML takes 1e3 for a float. nullopt of all else.
std::optional<std::int64_t> whole_value(const toml::node& node);

// A finite number (integer or float) within [min, max]; `what` names it in the message.
double read_number(const toml::node& node, const std::string& what, double min, double max);

// A number for all states, or a table of numbers for some of them; the others have `otherwise`.
std::vector<double> read_by_state(const toml::node& node, const std::string& what,
                                  const std::vector<std::string>& states,
                                  std::vector<double> otherwise, double min, double max);

// One table of a study; a missing table (nullptr) reads as empty. All throw InputError.
class TableReader {
 public:
  // Known are the keys of `declared`, with their ranges and choices; functions without these need
  // them.
  TableReader(const toml::table* table, const StudyTable& declared);
  // `name` as in "[integrate]", for messages. Every key that is asked for becomes known.
  TableReader(const toml::table* table, std::string name);

  bool has(const std::string& key) const { return table_ != nullptr && table_->contains(key); }
  // The node of a key, or nullptr.
  const toml::node* find(const std::string& key);
  // The table of a key, or nullptr when it is missing.
  const toml::table* table(const std::string& key);

  double number(const std::string& key, double fallback);
  double number(const std::string& key, double fallback, double min, double max);
  std::optional<double> optional_number(const std::string& key, double min, double max);
  std::size_t count(const std::string& key, std::size_t fallback);
  bool boolean(const std::string& key, bool fallback);
  // The text of a key that is declared no longer than that says.
  std::string text(const std::string& key, const std::string& fallback);
  // One of the choices; its index.
  std::size_t choice(const std::string& key, std::size_t fallback);
  std::size_t choice(const std::string& key, std::size_t fallback,
                     const std::vector<std::string>& choices);
  std::vector<std::string> texts(const std::string& key);
  // An array of numbers; a single number reads as an array of one.
  std::vector<double> numbers(const std::string& key, double min, double max);

  // Adds to the names that refuse_unknown() accepts and suggests.
  void know(const std::string& key);
  // Reports the first key that is not known, with the nearest known one.
  void refuse_unknown() const;

 private:
  const StudyKey& declared(const std::string& key) const;

  const toml::table* table_;
  const StudyTable* declared_ = nullptr;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace gearsweep
