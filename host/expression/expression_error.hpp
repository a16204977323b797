// Where the text of an expression is wrong.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gearsweep {

// The text is wrong; `position` is the byte where.
struct ExpressionError : std::runtime_error {
  ExpressionError(std::size_t at, const std::string& message)
      : std::runtime_error(message), position(at) {}
  std::size_t position;
};

// The line of a text with a caret under a position, in two lines; a long line is cut around it.
std::string with_caret(std::string_view text, std::size_t position);

}  // namespace gearsweep
