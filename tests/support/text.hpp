// Numbers as TOML text, with all their digits.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace gearsweep::testing {

inline std::string digits(double value) { return fmt::format("{:#.17g}", value); }

inline std::string digits(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(digits(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace gearsweep::testing
