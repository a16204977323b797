#include "study/detail/heading_unit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "study/detail/number_lines.hpp"

namespace gearsweep {
namespace {

// Other units of lengths. "nm" is a torque where there may be one.
constexpr std::string_view kForeignUnits[] = {"nm",      "cm",  "dm",   "in",   "inch",
                                              "inches",  "mil", "mils", "thou", "micron",
                                              "microns", "lb",  "lbf"};

// In small letters, with the micro sign, which UTF-8 has twice, as u.
std::string plain_word(std::string_view word) {
  std::string text(word);
  for (const std::string_view sign : {"\xC2\xB5", "\xCE\xBC"}) {
    const std::size_t at = text.find(sign);
    if (at != std::string::npos) text.replace(at, sign.size(), "u");
  }
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::optional<double> scale_of(std::span<const ValueUnit> units, const std::string& word) {
  for (const ValueUnit& unit : units) {
    std::string name = plain_word(unit.name);
    if (name == word) return unit.scale;
    std::erase(name, ' ');  // Nm
    if (name == word) return unit.scale;
  }
  return std::nullopt;
}

// The last word of a heading; of "N m" and its like both, with a blank between.
std::string last_words(std::span<const std::string_view> heading) {
  std::string word = plain_word(heading.back());
  if (heading.size() < 2) return word;
  const std::string before = plain_word(heading[heading.size() - 2]);
  const std::string bare = before.substr(before.find_first_not_of("([") == 1 ? 1 : 0);
  return bare == "n" || bare == "kn" ? before + " " + word : word;
}

bool is_any_unit(const std::string& word) {
  return word.find('/') != std::string::npos || scale_of(kStiffnessUnits, word) ||
         scale_of(kLengthUnits, word) || scale_of(kTorqueUnits, word) ||
         std::ranges::find(kForeignUnits, word) != std::end(kForeignUnits);
}

}  // namespace

double scale_in_heading(std::span<const ValueUnit> units, std::span<const std::string_view> heading,
                        const NumberLines& lines) {
  if (units.empty() || heading.empty()) return 1.0;
  std::string word = last_words(heading);
  const bool is_bracketed = word.size() > 2 && ((word.front() == '(' && word.back() == ')') ||
                                                (word.front() == '[' && word.back() == ']'));
  if (is_bracketed) word = word.substr(1, word.size() - 2);
  if (const std::optional<double> scale = scale_of(units, word)) return *scale;
  // "error_mm": what is not taken for a unit must not be one.
  const std::string ending = word.substr(word.rfind('_') + 1);
  if (scale_of(units, ending) == 1.0) return 1.0;
  if (!is_bracketed && !is_any_unit(ending)) return 1.0;
  std::vector<std::string_view> names;
  for (const ValueUnit& unit : units) names.push_back(unit.name);
  lines.fail(
      fmt::format("'{}' is no unit that these values may have; the last word of the heading "
                  "is one of {}",
                  shown_field(heading.back()), fmt::join(names, ", ")));
}

}  // namespace gearsweep
