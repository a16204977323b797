// A curve that covers its plane many times, as how often it is at each place.
#pragma once

#include <string>
#include <vector>

#include "plot/detail/picture.hpp"

namespace gearsweep {

inline constexpr const char* kDensestColour = "#08306b";

// "set" lines of its colours, which a plot of it needs.
std::string density_lines();

// How often the straight lines from each point to the next pass through each cell of the panel, in
// logarithmic shades; cells that nothing passes through stay as they are. An element of "plot".
std::string add_density(const std::vector<double>& x, const std::vector<double>& y,
                        const AxisRange& x_range, const AxisRange& y_range, PlotScript* script);

}  // namespace gearsweep
