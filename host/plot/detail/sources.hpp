// From files to a picture's script.
#pragma once

#include "plot/detail/picture.hpp"
#include "plot/plot.hpp"

namespace gearsweep {

// Of result files. Throw what plot_files throws, as far as it lies in the files.
PlotScript draw_maps(const Page& page, const PlotRequest& request);
// Of files of traces.
PlotScript draw_traces(const Page& page, const PlotRequest& request);
// Of one file of an order map.
PlotScript draw_orders(const PlotRequest& request);
// The width that this picture is made for without a size, in mm.
double usual_width(const PlotRequest& request);

}  // namespace gearsweep
