#include "study/toml_text.hpp"

#include <fmt/format.h>

namespace gearsweep {

// With all that TOML gives a meaning to by its number or letter.
std::string toml_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      out += std::string("\\") + letter;
    } else if (letter == '\n') {
      out += "\\n";
    } else if (code < ' ' || code == 0x7F) {
      out += fmt::format("\\u{:04X}", code);
    } else {
      out += letter;
    }
  }
  return out + "\"";
}

}  // namespace gearsweep
