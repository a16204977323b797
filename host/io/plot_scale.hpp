// Where the cells of a map lie and what colours they have. Private to this folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/result_file.hpp"

namespace gearsweep {

inline constexpr const char* kMissingColour = "#b3b3b3";

// Edges of the cells around the values of an axis, which go upwards: one more than values.
std::vector<double> cell_edges(const ResultAxis& axis);

// True when the values are so even on a linear scale that an image shows them in their places.
bool is_even(const ResultAxis& axis);

// Throws InputError when so many curves could not be told apart.
void ensure_tellable(std::size_t layers);
// One of several curves that lie over one another: "#0072b2", and as "plot" takes it with its
// dashes.
std::string layer_colour(std::size_t index);
std::string layer_line(std::size_t index);

// Colours from dark to bright that are perceptually uniform, as a "set palette" line.
std::string sequential_palette();

// The same for least < 0 < greatest: cool below zero, warm above it, white at zero. Either side has
// all of its shades, however small, so that weak chaos stands out; the colour bar shows the scale.
std::string diverging_palette(double least, double greatest);

// The classes of a map, each with its colour; `values` are what the map holds for them.
struct ClassScale {
  std::vector<double> values;
  std::vector<std::string> names, colours;  // one more than values when the last is for all others

  // The map's value as an index into the classes; NaN stays NaN, and so does a value of no class.
  double index_of(double value) const;
  // "set" lines of a y axis with the classes' names.
  std::string tics() const;
  // "set" lines of a palette and a colour bar with one colour per class.
  std::string palette() const;
};

// Classes with names, or the few whole numbers (such as periods) that are all a map holds, or
// nearly all: those that hardly occur are then one class, "other".
std::optional<ClassScale> class_scale(const ResultMap& map);

struct ValueRange {
  double least = 0.0, greatest = 1.0;
  bool clipped = false;
};

// Never empty. Where a few outliers would take all contrast from the rest, it leaves out one value
// in a thousand at either end, and is then `clipped`.
ValueRange colour_range(const std::vector<double>& values);

// Of all values, with a margin, so that nothing touches the frame.
ValueRange padded_range(const std::vector<double>& values);

}  // namespace gearsweep
