// A table as text: fields between commas, numbers that read back to the same double. Private to
// this folder.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

namespace gearsweep {

class CsvText {
 public:
  void add_name(const std::string& name) {
    start_field();
    text_ += name;
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

  std::string text_;
  bool row_is_empty_ = true;
};

}  // namespace gearsweep
