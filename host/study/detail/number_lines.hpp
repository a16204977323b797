// Text files of numbers in columns: what tables and lists of points have in common.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// The fields of a line, between which stands a comma, a semicolon or white space. '#' begins a
// comment.
std::vector<std::string_view> fields_of(std::string_view line);

// A number as 0.5 or 5e-1, the same in every locale; nothing where the field is none.
std::optional<double> number_in(std::string_view field);

// A field for a message: short and printable.
std::string shown_field(std::string_view field);

// Lines of a text, one after the other, numbered from 1.
class NumberLines {
 public:
  // what: "a table", for messages. Throws InputError for what is no text, or too large.
  NumberLines(std::string_view text, std::size_t max_bytes, const std::string& what,
              std::string source);

  // The fields of the next line that has any; false after the last one.
  bool next(std::vector<std::string_view>* fields);
  // Throws InputError "source:line: message".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view text_;
  std::string source_;
  std::size_t line_ = 0;
};

// The text of a file, at most max_bytes of it and one more, which tells that there are too many.
// what: "a table". Throws InputError.
std::string number_file_text(const std::string& path, std::size_t max_bytes,
                             const std::string& what);

}  // namespace gearsweep
