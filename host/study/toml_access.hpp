// Reading TOML with messages that name the place, what is wrong and what would be right. Private to
// this folder.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// "study.toml:14"; for a value that an override gave, "--set a.b=v".
std::string place_of(const toml::node& node);

// Throws InputError "place: message".
[[noreturn]] void fail_at(const toml::node& node, const std::string& message);

// A finite number (integer or float) within [least, greatest]; `what` names it in the message.
double read_number(const toml::node& node, const std::string& what, double least, double greatest);

// One table of a study. Every key that is asked for becomes known; refuse_unknown() then reports
// the first key that nothing asked for, with the nearest known one. All throw InputError.
class TableReader {
 public:
  // `name` as in "[integrate]", for messages. A missing table (nullptr) reads as empty.
  TableReader(const toml::table* table, std::string name);

  // The node of a key, or nullptr.
  const toml::node* find(const std::string& key);
  // The table of a key, or nullptr when it is missing.
  const toml::table* table(const std::string& key);

  double number(const std::string& key, double fallback, double least, double greatest);
  std::optional<double> optional_number(const std::string& key, double least, double greatest);
  std::size_t count(const std::string& key, std::size_t fallback, std::size_t least,
                    std::size_t greatest);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  // One of `choices`; its index.
  std::size_t choice(const std::string& key, std::size_t fallback,
                     const std::vector<std::string>& choices);
  std::vector<std::string> texts(const std::string& key);
  // An array of numbers; a single number reads as an array of one.
  std::vector<double> numbers(const std::string& key, double least, double greatest);

  // Adds to the names that refuse_unknown() accepts and suggests.
  void know(const std::string& key);
  void refuse_unknown() const;

 private:
  const toml::table* table_;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace gearsweep
