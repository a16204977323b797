// A table as text: fields between commas, numbers that read back to the same double.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

namespace gearsweep {

class CsvText {
 public:
  // "omega [varpi]": units stand in the header itself, since a row or a comment of units is no
  // number to a reader that is not told of it. Without a unit the name alone.
  void add_name(const std::string& name, const std::string& unit = "") {
    start_field();
    add_text(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
  }
  // An empty field for what is not a number.
  void add_number(double number) {
    start_field();
    if (!std::isnan(number)) fmt::format_to(std::back_inserter(text_), "{}", number);
  }
  void end_row() {
    text_ += '\n';
    row_is_empty_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  void start_field() {
    if (!row_is_empty_) text_ += ',';
    row_is_empty_ = false;
  }

  // In quotes where a reader would take it for more than one field (RFC 4180).
  void add_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
      text_ += text;
      return;
    }
    text_ += '"';
    for (const char letter : text)
      text_ += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    text_ += '"';
  }

  std::string text_;
  bool row_is_empty_ = true;
};

}  // namespace gearsweep
