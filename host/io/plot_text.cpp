#include "io/plot_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <map>
#include <set>

#include "model/names.hpp"

namespace gearsweep {
namespace {

bool is_word_letter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

std::string typeset_symbol(const std::string& word) {
  static const std::map<std::string, std::string> kSymbols = {
      {"varpi", "ϖ"}, {"theta", "θ"}, {"tau", "τ"}, {"k0", "k_{0}"}};
  const auto symbol = kSymbols.find(word);
  return symbol == kSymbols.end() ? literal(word) : symbol->second;
}

// One letter after the only underscore is a subscript.
std::string typeset_word(const std::string& word) {
  const std::size_t underscore = word.find('_');
  if (underscore == 0 || underscore == std::string::npos || underscore + 2 != word.size()) {
    return typeset_symbol(word);
  }
  return fmt::format("{}_{{{}}}", typeset_symbol(word.substr(0, underscore)),
                     word.substr(underscore + 1));
}

}  // namespace

std::string quote_tic(std::string_view text) {
  std::string format;
  for (const char letter : text) format += letter == '%' ? "%%" : std::string(1, letter);
  return quote(format);
}

std::string quote(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    // gnuplot looks for macros and for commands to run in strings too, so what could begin one is
    // written by its number.
    const bool risky = std::string_view("\"'`@").find(letter) != std::string_view::npos;
    if (letter == '\\') {
      quoted += "\\\\";
    } else if (risky || static_cast<unsigned char>(letter) < ' ') {
      quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  const auto goes_on = [&](std::size_t i) {  // inside a letter of UTF-8
    return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  std::size_t end = longest;
  while (end > 0 && goes_on(end)) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string literal(std::string_view text) {
  std::string markup;
  for (const char letter : shortened(text)) {
    if (std::string_view("\\{}^_@&~").find(letter) != std::string_view::npos) markup += '\\';
    markup += letter;
    // Lest what follows makes the number of a letter of it: U+0041.
    if (letter == '\\') markup += "{}";
  }
  return markup;
}

std::string typeset(std::string_view text) {
  std::string markup, word;
  for (const char letter : shortened(text)) {
    if (is_word_letter(letter)) {
      word += letter;
      continue;
    }
    markup += typeset_word(word) + literal(std::string(1, letter));
    word.clear();
  }
  return markup + typeset_word(word);
}

std::string label_of(const std::string& name, const std::string& unit) {
  if (unit.empty() || unit == "1") return literal(name);
  return fmt::format("{} [{}]", literal(name), typeset(unit));
}

std::string label_of(const ResultAxis& axis) {
  constexpr std::size_t kLongest = 45;
  // A meaning such as "mesh frequency / varpi" says the unit already.
  const bool says_unit = axis.meaning.ends_with("/ " + axis.unit);
  const std::string name = label_of(axis.name, says_unit ? "1" : axis.unit);
  if (axis.meaning.empty() || axis.meaning.size() > kLongest) return label_of(axis.name, axis.unit);
  return fmt::format("{}, {}", typeset(axis.meaning), name);
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& word : split_words(shortened(text))) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

std::vector<std::string> first_distinct(const std::vector<std::vector<std::string>>& lists) {
  for (const std::vector<std::string>& names : lists) {
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
  }
  std::vector<std::string> numbered = lists.front();
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    numbered[i] = fmt::format("{} {}", i + 1, numbered[i]);
  }
  return numbered;
}

}  // namespace gearsweep
