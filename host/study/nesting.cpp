#include "study/nesting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "model/error.hpp"

namespace gearsweep {
namespace {

// Behind the string that opens at `at`: "...", '...', """...""" or '''...'''.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string long_mark(3, quote);
  const bool is_long = text.substr(at, 3) == long_mark;
  const std::string_view mark = is_long ? std::string_view(long_mark) : text.substr(at, 1);
  for (at += mark.size(); at < text.size(); ++at) {
    if (text.substr(at, mark.size()) == mark) return at + mark.size();
    if (!is_long && text[at] == '\n') return at;
    if (quote == '"' && text[at] == '\\') ++at;
  }
  return text.size();
}

}  // namespace

void refuse_deep_keys(std::string_view text, const std::string& source) {
  // What cannot stand within a key, quoted parts left aside.
  constexpr std::string_view kBetweenKeys = "\n=,[]{}";
  std::size_t dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    if (letter == '"' || letter == '\'') {
      at = behind_string(text, at);
      continue;
    }
    if (letter == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (kBetweenKeys.find(letter) != std::string_view::npos) dots = 0;
    if (letter == '.' && ++dots >= kMaxParts) {
      const auto line =
          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      throw InputError(
          fmt::format("{}:{}: a key of more than {} parts", source, line + 1, kMaxParts));
    }
    ++at;
  }
}

}  // namespace gearsweep
