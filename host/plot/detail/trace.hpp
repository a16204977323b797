// Pictures of traces.
#pragma once

#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "model/exciting_meshes.hpp"
#include "plot/detail/picture.hpp"

namespace gearsweep {

struct TraceLayer {
  std::string name;  // for the key; markup
  Trace trace;       // of the periods that are shown
};

// Traces laid over one another; all have the channels that are plotted.
struct TracePicture {
  std::vector<TraceLayer> layers;
  // What is plotted, of a phase portrait over `across`.
  ChannelInfo channel, across;
  std::string title;
  std::string remark;                // markup
  std::string forcing;               // whose frequency orders are multiples of: "mesh" or "forcing"
  std::vector<ExcitingMesh> meshes;  // that of the phase first
  std::string period;  // whose period time is counted in; a shaft's forcing is several of the mesh
  bool is_clockless = false;  // there is no forcing
  double milliseconds = 0.0;  // of one unit of the model's time; 0: time is counted as above
  double orders = 10.0;       // the highest of a spectrum
  // How many periods at most the histories of a portrait show: less would be too little for the
  // other panels.
  std::size_t recent = 10;
};

// What stands in one frame. Its data are in the script that it was made with.
struct TracePanel {
  std::string kind;                                   // "phase portrait"
  std::string subtitle;                               // what is shown, in words
  PanelAxis x, y;                                     // labels of one line
  std::string lines;                                  // further "set" lines
  std::string elements;                               // of "plot"
  KeyEntry::Kind layer_kind = KeyEntry::Kind::kLine;  // how the key shows a layer
  std::vector<KeyEntry> key;                          // of all else
};

TracePanel time_panel(const Page& page, const TracePicture& picture, PlotScript* script);
// The channel over time, with the flanks in contact: as bands of one trace, as strips of several.
TracePanel force_panel(const Page& page, const TracePicture& picture, PlotScript* script);
// Curves, and dots at phase 0 where there is one.
TracePanel phase_panel(const Page& page, const TracePicture& picture, PlotScript* script);
// The dots alone.
TracePanel section_panel(const Page& page, const TracePicture& picture, PlotScript* script);
// Throws what amplitude_spectrum() throws.
TracePanel spectrum_panel(const Page& page, const TracePicture& picture, PlotScript* script);

// Time history, phase portrait, force and spectrum of the state `across`. Where the traces have no
// flanks in contact, a section stands in place of the force, and without forcing the history of
// what the portrait has over the state. The style's limits and labels of axes are the history's,
// those of x the force's too.
std::vector<TracePanel> portrait_panels(const Page& page, const TracePicture& picture,
                                        PlotScript* script);

// The whole script of panels in one frame, or row by row in two columns; their data must be there.
void lay_out(const Page& page, const TracePicture& picture, const std::vector<TracePanel>& panels,
             PlotScript* script);

// -1 when the trace has no such channel.
int find_channel(const Trace& trace, const std::string& name);
// The channel that is the force between the teeth, of several the first; nullptr: there is none.
const ChannelInfo* force_of(const Trace& trace);
// The values of a channel that the trace has.
const std::vector<double>& values_of(const Trace& trace, const std::string& name);
// All layers' values of a channel.
std::vector<double> all_values(const TracePicture& picture, const std::string& name);
// Time of each moment from the first on: in forcing periods, or of a model without forcing in its
// own time.
std::vector<double> times_of(const Trace& trace);

// So many periods in all, the last one perhaps in part.
double whole_periods(const Trace& trace);
// At most so many last periods, from time 0 on.
Trace last_periods(const Trace& trace, std::size_t periods);
// The same as the picture shows it: in milliseconds where these are known.
std::vector<double> shown_times(const TracePicture& picture, const Trace& trace);
// The axis of this time, and that of the channel.
PanelAxis time_axis(const Page& page, const TracePicture& picture);
PanelAxis channel_axis(const Page& page, const TracePicture& picture, const ValueRange& range);
// The label that the style gives, or the panel's own; the range that it leaves of a panel's own.
std::vector<std::string> axis_text(const std::optional<std::string>& given, const std::string& own);
AxisRange shown_range(const ValueRange& range, const Limits& limits, const std::string& option);
// The channel of each layer over time, as elements of "plot".
std::string add_histories(const TracePicture& picture, PlotScript* script);
// Marks where the motion comes to a surface, as further elements and in the key; nothing where it
// comes to none.
void add_events(const TracePicture& picture, TracePanel* panel, PlotScript* script);

}  // namespace gearsweep
