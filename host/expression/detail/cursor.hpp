// A place in the text of an expression, and what may be taken from there.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gearsweep {

class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  // The byte behind the spaces that follow.
  std::size_t here();
  // The character there; 0 at the end.
  char next();
  bool is_text_empty() const { return text_.empty(); }
  void go_to(std::size_t at) { at_ = at; }

  // Whether this follows; then the cursor is behind it.
  bool take(std::string_view token);
  // A word as a whole: not the beginning of a name.
  bool take_word(std::string_view word);
  // A '*' that is no '**'.
  bool take_times();
  // Letters, digits and _, the first one a letter; empty where there is none. With `choice`, a
  // point and more may follow: option.choice.
  std::string take_name(bool choice);

  // These throw ExpressionError.
  double take_number();
  // A name between quotes of either kind; there is no way to write such a quote within.
  std::string take_file();

 private:
  bool is_in_name(std::size_t at) const;

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace gearsweep
