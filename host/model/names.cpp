#include "model/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace gearsweep {
namespace {

// Smallest number of insertions, deletions, substitutions and swaps of neighbours (optimal string
// alignment), case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto same = [&](std::size_t i, std::size_t j) {
    return std::tolower(static_cast<unsigned char>(a[i])) ==
           std::tolower(static_cast<unsigned char>(b[j]));
  };
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1,
                             cost[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string suggest_name(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  // The distance takes time and memory by the product of the lengths, and names are shorter.
  constexpr std::size_t kLongest = 100;
  const auto distance = [&](std::string_view candidate) {
    return edit_distance(name.substr(0, kLongest), candidate.substr(0, kLongest));
  };
  const auto nearest =
      std::min_element(known.begin(), known.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const std::size_t tolerated = std::max<std::size_t>(1, std::min(kLongest, name.size()) / 3);
  if (distance(*nearest) <= tolerated && nearest->size() > 1) {
    return fmt::format("; did you mean '{}'?", *nearest);
  }
  constexpr std::size_t kListed = 12;
  const auto end = known.begin() + static_cast<std::ptrdiff_t>(std::min(kListed, known.size()));
  return fmt::format("; known: {}{}", fmt::join(known.begin(), end, ", "),
                     known.size() > kListed ? ", ..." : "");
}

std::vector<std::string> split_words(std::string_view words) {
  std::istringstream in{std::string(words)};
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts = {""};
  for (const char letter : text) {
    if (letter == separator) {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  return parts;
}

}  // namespace gearsweep
