// Pictures of traces. Private to this folder.
#pragma once

#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "io/plot_picture.hpp"

namespace gearsweep {

struct TraceLayer {
  std::string name;  // for the key
  Trace trace;       // of the periods that are shown
};

// Traces laid over one another; all have the channels that are drawn.
struct TracePicture {
  std::vector<TraceLayer> layers;
  // What is drawn, of a phase portrait over `across`.
  ChannelInfo channel, across;
  std::string title, remark;
  std::string forcing;   // what a forcing period is called: "mesh" or "forcing"
  double orders = 10.0;  // the highest of a spectrum
};

PlotScript draw_time(const TracePicture& picture);
// The channel over time, with the flanks in contact: as bands of one trace, as strips of several.
PlotScript draw_force(const TracePicture& picture);
// Curves, and dots at phase 0.
PlotScript draw_phase(const TracePicture& picture);
// The dots alone.
PlotScript draw_section(const TracePicture& picture);
// Throws what amplitude_spectrum() throws.
PlotScript draw_spectrum(const TracePicture& picture);

// -1 when the trace has no such channel.
int find_channel(const Trace& trace, const std::string& name);
// Of a channel that the trace has.
const std::vector<double>& values_of(const Trace& trace, const std::string& name);
// All layers' values of a channel.
std::vector<double> all_values(const TracePicture& picture, const std::string& name);
// Time of each moment in forcing periods, from the first on.
std::vector<double> periods_of(const Trace& trace);
// The longest layer's time in forcing periods.
double last_period(const TracePicture& picture);

// "set" lines that all of them share. subtitle: what is shown; key: entries beside the layers,
// which stand there where they are several.
std::string trace_frame(const TracePicture& picture, const std::string& subtitle,
                        const std::vector<std::string>& key);
// "set" lines of an axis of time in forcing periods.
std::string time_axis(const TracePicture& picture);
// "set" lines of the channel's axis.
std::string channel_axis(const TracePicture& picture, const ValueRange& range);
// A layer's name where there are several, as a string of gnuplot.
std::string key_title(const TracePicture& picture, std::size_t layer);
// The channel of each layer over time, as elements of "plot".
void add_histories(const TracePicture& picture, PlotScript* script);

}  // namespace gearsweep
