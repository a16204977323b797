// The text of an expression, with its place in a file.
#pragma once

#include <compare>
#include <cstddef>
#include <string>

namespace gearsweep {

struct ExpressionText {
  std::string text;
  std::string file;  // "impact.toml", for messages; "--set a.b=v" of a value that an option gave
  std::size_t line = 0;    // 0: `file` says all
  std::size_t column = 0;  // of the text's first character

  // "impact.toml:12"
  std::string place() const { return line == 0 ? file : file + ":" + std::to_string(line); }
  auto operator<=>(const ExpressionText&) const = default;
};

}  // namespace gearsweep
