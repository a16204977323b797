// Numbers in texts of users.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace gearsweep {

// The number that all of a text is, in C's notation and whatever the locale; nothing where it is
// none, or does not fit. "inf" and "nan" are numbers of floating point.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace gearsweep
