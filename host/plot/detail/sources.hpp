// From files to a picture's script.
#pragma once

#include "plot/detail/picture.hpp"
#include "plot/plot.hpp"

namespace gearsweep {

// Pictures of result files. They throw what plot_files throws, as far as it lies in the files.
PlotScript plot_maps(const Page& page, const PlotRequest& request);
// Pictures of files of traces.
PlotScript plot_traces(const Page& page, const PlotRequest& request);
// A picture of one file of an order map.
PlotScript plot_orders(const PlotRequest& request);
// The width that this picture is made for without a size, in mm.
double usual_width(const PlotRequest& request);

}  // namespace gearsweep
