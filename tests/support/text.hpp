// Text of TOML: numbers with all their digits, and a part replaced.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace gearsweep::testing {

inline std::string digits(double value) { return fmt::format("{:#.17g}", value); }

inline std::string digits(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(digits(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// Throws std::logic_error where the text does not have it.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace gearsweep::testing
