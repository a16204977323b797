// Colour maps by name.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gearsweep {

// Names as in matplotlib; each also reversed, as "viridis_r".
std::vector<std::string> colormap_names();

// Whether its middle stands for zero.
bool is_diverging(const std::string& name);

// The colours of the smallest and of the largest value.
std::pair<std::string, std::string> end_colours(const std::string& name);

// A "set palette" line. Of a diverging map over smallest < 0 < largest the middle is at zero, and
// either side has all of its shades, however small, so that weak chaos stands out.
std::string palette_line(const std::string& name, double min, double max);

}  // namespace gearsweep
