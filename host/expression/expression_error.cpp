#include "expression/expression_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearsweep {

std::string with_caret(std::string_view text, std::size_t position) {
  constexpr std::size_t kBefore = 60, kWidth = 90;
  position = std::min(position, text.size());
  const std::size_t newline =
      position == 0 ? std::string_view::npos : text.rfind('\n', position - 1);
  const std::size_t line = newline == std::string_view::npos ? 0 : newline + 1;
  const std::size_t begin = std::max(line, position > kBefore ? position - kBefore : 0);
  const std::size_t end = std::min({text.find('\n', position), text.size(), begin + kWidth});
  std::string shown(text.substr(begin, end - begin));
  std::ranges::replace(shown, '\t', ' ');
  // A character of several bytes takes one column.
  const auto columns =
      std::count_if(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(position - begin),
                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return fmt::format("  {}\n  {}^", shown, std::string(static_cast<std::size_t>(columns), ' '));
}

}  // namespace gearsweep
