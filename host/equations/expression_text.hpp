// The text of an expression, with its place in a file.
#pragma once

#include <cstddef>
#include <string>

namespace gearsweep {

struct ExpressionText {
  std::string text;
  std::string file;  // "impact.toml", for messages
  std::size_t line = 0;
  std::size_t column = 0;  // of the text's first character
};

// Throws InputError "place: message" with a caret under the place. position: byte of the text.
[[noreturn]] void fail_in(const ExpressionText& text, std::size_t position,
                          const std::string& message);

// What an expression of numbers alone comes to, as "pi + pi/sqrt(25)": finite. Throws InputError.
double number_of(const ExpressionText& text);

}  // namespace gearsweep
