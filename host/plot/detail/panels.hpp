// Over one axis: curves, classes and bifurcation diagrams; several quantities above one another,
// and several studies laid over one another.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plot/detail/picture.hpp"

namespace gearsweep {

struct Stack {
  std::vector<std::vector<Picture>> panels;  // [quantity][study], all over an axis of one name
  std::vector<std::string> names;            // of the studies, for the key; markup
  // Where two studies go along the axis in opposite directions: the one that goes upwards.
  std::optional<std::size_t> upwards = {};
};

// The studies where they are several, bands, parts of a quantity, missing values.
std::vector<KeyEntry> key_entries(const Stack& stack);

PlotScript plot_stack(const Page& page, const Stack& stack);

}  // namespace gearsweep
