// A channel over time with the flanks in contact behind it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "plot/detail/scale.hpp"
#include "plot/detail/text.hpp"
#include "plot/detail/trace.hpp"

namespace gearsweep {
namespace {

struct Band {
  double from = 0.0, to = 0.0;  // as of shown_times()
  int flank = 0;                // as the channel `contact`
};

// The time between two moments with different flanks is shared between them.
std::vector<Band> bands_of(const TracePicture& picture, const Trace& trace) {
  const std::vector<double> time = shown_times(picture, trace);
  const std::vector<double>& contact = values_of(trace, "contact");
  std::vector<Band> bands;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const int flank = contact[i] > 1.5 ? 2 : contact[i] > 0.5 ? 1 : contact[i] < -0.5 ? -1 : 0;
    if (bands.empty() || bands.back().flank != flank) {
      const double from = bands.empty() ? time[i] : 0.5 * (time[i - 1] + time[i]);
      if (!bands.empty()) bands.back().to = from;
      bands.push_back({from, from, flank});
    }
    bands.back().to = time[i];
  }
  return bands;
}

struct FlankStyle {
  int flank;
  const char *name, *colour;
};
constexpr std::array<FlankStyle, 4> kFlanks = {{{1, "drive flank", "#d3e4f1"},
                                                {0, "no contact", "#ffffff"},
                                                {-1, "back flank", "#e2b9d3"},
                                                {2, "both flanks (wedged)", "#a9cfae"}}};

// Adds boxes over the part [bottom, top] of the picture's height to the elements of "plot"; returns
// whether there are any.
bool add_boxes(const std::vector<Band>& bands, int flank, double bottom, double top,
               const std::string& fill, TracePanel* panel, PlotScript* script) {
  const auto count = static_cast<std::size_t>(std::count_if(
      bands.begin(), bands.end(), [&](const Band& band) { return band.flank == flank; }));
  if (count == 0) return false;
  panel->elements +=
      fmt::format("{} using 1:2:3:4:5:6 axes x1y2 with boxxyerror {} notitle, \\\n     ",
                  next_records(*script, count, 6), fill);
  for (const Band& band : bands) {
    if (band.flank != flank) continue;
    append_numbers({band.from, bottom, band.from, band.to, bottom, top}, &script->data);
  }
  return true;
}

std::string filled(const std::string& colour) {
  return fmt::format("fillstyle solid 1 noborder linecolor rgb '{}'", colour);
}

void add_entry(const std::string& colour, const std::string& name, TracePanel* panel) {
  panel->key.push_back({KeyEntry::Kind::kBox, colour, "1", name});
}

// Bands of one trace over the whole height.
void add_bands(const TracePicture& picture, TracePanel* panel, PlotScript* script) {
  const std::vector<Band> bands = bands_of(picture, picture.layers.front().trace);
  for (const FlankStyle& style : kFlanks) {
    if (add_boxes(bands, style.flank, 0.0, 1.0, filled(style.colour), panel, script)) {
      add_entry(style.colour, style.name, panel);
    }
  }
}

constexpr double kStrip = 0.045;  // of the height

// A strip of each trace in its colour, the first at the top: a tint on the drive flank, nothing
// without contact, full on the back flank, black on both.
void add_strips(const TracePicture& picture, TracePanel* panel, PlotScript* script) {
  bool any_drive = false, any_back = false, any_wedged = false;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const double bottom = kStrip * static_cast<double>(picture.layers.size() - 1 - i);
    const std::vector<Band> bands = bands_of(picture, picture.layers[i].trace);
    const auto add = [&](int flank, const std::string& colour) {
      return add_boxes(bands, flank, bottom + 0.006, bottom + kStrip - 0.003, filled(colour), panel,
                       script);
    };
    const std::string transparent = fmt::format("#b0{}", layer_colour(i).substr(1));
    any_drive = add(1, transparent) || any_drive;
    any_back = add(-1, layer_colour(i)) || any_back;
    any_wedged = add(2, "#000000") || any_wedged;
  }
  if (any_drive) add_entry("#cccccc", "drive flank", panel);
  if (any_back) add_entry("#555555", "back flank", panel);
  if (any_wedged) add_entry("#000000", "both flanks (wedged)", panel);
}

}  // namespace

TracePanel force_panel(const Page& page, const TracePicture& picture, PlotScript* script) {
  const bool several = picture.layers.size() > 1;
  ValueRange range = padded_range(all_values(picture, picture.channel.name));
  if (several) {
    const double part = kStrip * static_cast<double>(picture.layers.size());
    range.min -= (range.max - range.min) * part / (1.0 - part);
  }
  TracePanel panel;
  panel.kind = "force and flanks";
  panel.subtitle = picture.channel.meaning;
  panel.x = time_axis(page, picture);
  panel.y = channel_axis(page, picture, range);
  panel.lines = "set border front\n";
  if (several) {
    add_strips(picture, &panel, script);
  } else {
    add_bands(picture, &panel, script);
  }
  panel.elements += add_histories(picture, script);
  return panel;
}

}  // namespace gearsweep
