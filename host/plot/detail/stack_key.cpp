// The key of curves over an axis.
#include <fmt/format.h>

#include <algorithm>

#include "plot/band.hpp"
#include "plot/detail/panels.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// What the marks of missing values stand for: in words where all panels say the same.
std::vector<KeyEntry> missing_entries(const Stack& stack) {
  std::vector<KeyEntry> entries;
  const bool is_alone = stack.names.size() == 1;
  for (std::size_t i = 0; i < stack.names.size(); ++i) {
    std::string note;
    for (const std::vector<Picture>& panel : stack.panels) {
      const std::string& own = panel[i].missing.note;
      if (!own.empty()) note = note.empty() || note == own ? own : "no value";
    }
    if (note.empty()) continue;
    entries.push_back(
        {KeyEntry::Kind::kTriangle, is_alone ? kMissingColour : layer_colour(i), "1",
         is_alone ? literal(note) : fmt::format("{}: {}", stack.names[i], literal(note))});
  }
  return entries;
}

// What a band has in it; all panels have the same percentiles.
std::vector<KeyEntry> band_entries(const Stack& stack) {
  for (const std::vector<Picture>& panel : stack.panels) {
    const std::optional<CurveBand>& band = panel.front().band;
    if (!band) continue;
    std::vector<KeyEntry> entries = {
        {KeyEntry::Kind::kLine, layer_colour(0), "1", kNominalMeaning},
        {KeyEntry::Kind::kBox, kBandColour, "1", literal(band->meaning)}};
    if (band->median) {
      entries.push_back({KeyEntry::Kind::kThinLine, kMedianColour, "1", kMedianMeaning});
    }
    return entries;
  }
  return {};
}

}  // namespace

std::vector<KeyEntry> key_entries(const Stack& stack) {
  std::vector<KeyEntry> entries;
  const auto is_dotted = [](const std::vector<Picture>& panel) {
    const ResultMap& map = panel.front().map;
    return map.is_poincare() || !map.flags.empty();
  };
  const bool all_dotted = std::all_of(stack.panels.begin(), stack.panels.end(), is_dotted);
  for (std::size_t i = 0; i < stack.names.size() && stack.names.size() > 1; ++i) {
    entries.push_back({all_dotted ? KeyEntry::Kind::kDot : KeyEntry::Kind::kLine, layer_colour(i),
                       layer_dashes(i), stack.names[i]});
  }
  const std::vector<KeyEntry> of_band = band_entries(stack);
  entries.insert(entries.end(), of_band.begin(), of_band.end());
  if (stack.names.size() == 1) {
    for (const std::vector<Picture>& panel : stack.panels) {
      const ResultMap& map = panel.front().map;
      if (map.part_count() == 1 || map.is_poincare()) continue;
      const std::string what = literal(map.dimension);
      const std::vector<ChannelInfo>& parts = map.parts;
      entries.push_back({KeyEntry::Kind::kLine, kFirstPartColour, "1",
                         fmt::format("{} {}", what, literal(parts.front().name))});
      entries.push_back(
          {KeyEntry::Kind::kLine, kOtherPartsColour, "1",
           fmt::format("{} {} to {}", what, literal(parts[1].name), literal(parts.back().name))});
    }
  }
  const std::vector<KeyEntry> missing = missing_entries(stack);
  entries.insert(entries.end(), missing.begin(), missing.end());
  return entries;
}

}  // namespace gearsweep
