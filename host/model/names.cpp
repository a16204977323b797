#include "model/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>
#include <utility>

namespace gearsweep {
namespace {

// Names are shorter; the distance takes time by the product of the lengths.
constexpr std::size_t kLongest = 100;

std::string lowered(std::string_view name) {
  std::string out(name.substr(0, kLongest));
  for (char& letter : out) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return out;
}

// Smallest number of insertions, deletions, substitutions and swaps of neighbours (optimal string
// alignment). Row by row: `before` and `earlier` are the two before the row that is filled.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> earlier, before, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    earlier = std::exchange(before, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], earlier[j - 2] + 1);
      }
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> longer_names(std::string_view name,
                                      const std::vector<std::string>& known) {
  constexpr std::size_t kShortest = 3, kFew = 6;
  std::vector<std::string> found;
  if (name.size() < kShortest || name.size() > kLongest) return found;
  const std::string words = fmt::format("_{}_", lowered(name));
  for (const std::string& candidate : known) {
    if (fmt::format("_{}_", lowered(candidate)).find(words) != std::string::npos) {
      found.push_back(candidate);
    }
  }
  if (found.size() > kFew) found.clear();
  return found;
}

std::string suggest_name(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  std::vector<std::size_t> distances;
  for (const std::string& candidate : known) {
    distances.push_back(edit_distance(lowered(name), lowered(candidate)));
  }
  const auto nearest = std::min_element(distances.begin(), distances.end());
  const std::string& found = known[static_cast<std::size_t>(nearest - distances.begin())];
  const std::size_t tolerated = std::max<std::size_t>(1, std::min(kLongest, name.size()) / 3);
  if (*nearest <= tolerated && found.size() > 1) return fmt::format("; did you mean '{}'?", found);
  const std::vector<std::string> longer = longer_names(name, known);
  if (!longer.empty()) {
    return fmt::format("; did you mean '{}'?", fmt::join(longer, "' or '"));
  }
  constexpr std::size_t kListed = 12;
  const auto end = known.begin() + static_cast<std::ptrdiff_t>(std::min(kListed, known.size()));
  return fmt::format("; known: {}{}", fmt::join(known.begin(), end, ", "),
                     known.size() > kListed ? ", ..." : "");
}

std::string kernel_name(std::string_view name) { return "u_" + std::string(name); }

std::string name_in_list(const std::string& list, std::size_t i) {
  return i == 0 ? list : fmt::format("{}_{}", list, i + 1);
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
