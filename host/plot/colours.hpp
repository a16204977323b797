// Colours of pictures: maps of colours by name, and those of curves, dots and missing points.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gearsweep {

inline constexpr const char* kMissingColour = "#b3b3b3";
inline constexpr const char* kMissingClassColour = "#000000";  // where classes are grey

// Where a quantity has several numbers at a point, its first curve lies over the others. The first
// Lyapunov exponent is the one that tells chaos.
inline constexpr const char* kFirstPartColour = "#d55e00";
inline constexpr const char* kOtherPartsColour = "#56b4e9";

// Names as in matplotlib; each also reversed, as "viridis_r".
std::vector<std::string> colormap_names();

// Throws InputError when there is none of this name.
void ensure_colormap(const std::string& name);

// Whether its middle stands for zero.
bool is_diverging(const std::string& name);

// The colours of the smallest and of the largest value.
std::pair<std::string, std::string> end_colours(const std::string& name);

// Exponents of any kind, whose sign tells chaos.
bool is_signed(const std::string& quantity);

// The map that suits a quantity of this name: of exponents a diverging one, whatever their signs
// are, so that a colour means the same in every map of exponents.
std::string usual_colormap(const std::string& quantity);

// A place on the scale of values, and the colour there; between them colours are mixed. Of a map
// without a middle the places go from 0 to 1.
struct ColourAnchor {
  double place = 0.0;
  std::string colour;
};

// A diverging map over min <= 0 <= max has its middle at zero, and either side has all of its
// shades, however small, so that weak chaos stands out; a side that the range does not have, none.
std::vector<ColourAnchor> colour_anchors(const std::string& name, double min, double max);

// The anchors as a "set palette" line.
std::string palette_line(const std::string& name, double min, double max);

// Throws InputError when so many curves could not be told apart.
void ensure_tellable(std::size_t layers);
// One of several curves that lie over one another: "#0072b2", and its dashes.
std::string layer_colour(std::size_t index);
std::string layer_dashes(std::size_t index);
// The same of dots.
std::string dot_colour(std::size_t layer, std::size_t layers);

}  // namespace gearsweep
