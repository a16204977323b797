// The dots of a bifurcation diagram.
#pragma once

#include <string>
#include <vector>

#include "plot/detail/picture.hpp"

namespace gearsweep {

// The samples of the studies of one panel as dots, the first ones larger, so that the others do not
// hide them. Where many samples fall on one place the dots are dark, where they spread they are
// pale: branches and density are both seen. In vector formats the dots are plotted into one image
// first, `number` of the picture's (from 1). Returns elements of "plot".
std::string add_dots(const Page& page, const std::vector<Picture>& layers, const AxisRange& x,
                     const AxisRange& y, const Frame& frame, std::size_t number,
                     PlotScript* script);

}  // namespace gearsweep
