// Pictures of traces. Private to this folder.
#pragma once

#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "io/plot_picture.hpp"

namespace gearsweep {

struct TraceLayer {
  std::string name;  // for the key; markup
  Trace trace;       // of the periods that are shown
};

// Traces laid over one another; all have the channels that are drawn.
struct TracePicture {
  std::vector<TraceLayer> layers;
  // What is drawn, of a phase portrait over `across`.
  ChannelInfo channel, across;
  std::string title;
  std::string remark;    // markup
  std::string forcing;   // what a forcing period is called: "mesh" or "forcing"
  double orders = 10.0;  // the highest of a spectrum
};

PlotScript draw_time(const Page& page, const TracePicture& picture);
// The channel over time, with the flanks in contact: as bands of one trace, as strips of several.
PlotScript draw_force(const Page& page, const TracePicture& picture);
// Curves, and dots at phase 0.
PlotScript draw_phase(const Page& page, const TracePicture& picture);
// The dots alone.
PlotScript draw_section(const Page& page, const TracePicture& picture);
// Throws what amplitude_spectrum() throws.
PlotScript draw_spectrum(const Page& page, const TracePicture& picture);

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

// The names of the layers, where they are several.
std::vector<KeyEntry> layer_entries(const TracePicture& picture, KeyEntry::Kind kind);
// The axis of time in forcing periods, and that of the channel.
PanelAxis time_axis(const Page& page, const TracePicture& picture);
PanelAxis channel_axis(const Page& page, const TracePicture& picture, const ValueRange& range);
// The whole script around the elements of its "plot". subtitle: what is shown; lines: further "set"
// lines; its data must be there.
void finish_trace(const Page& page, const TracePicture& picture, const std::string& subtitle,
                  const std::vector<KeyEntry>& key, PanelAxis x, PanelAxis y,
                  const std::string& lines, PlotScript* script);
// The channel of each layer over time, as elements of "plot".
void add_histories(const TracePicture& picture, PlotScript* script);

}  // namespace gearsweep
