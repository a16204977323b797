// One picture and the gnuplot script that plots it.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plot/detail/page.hpp"
#include "plot/detail/scale.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

// Points without a value.
struct MissingPoints {
  std::vector<bool> mask;  // [point]
  std::string note;        // "diverged at 12 of 100 points"; empty when there are none
};

// What a line, dot or box stands for, at the foot of a picture.
struct KeyEntry {
  enum class Kind { kLine, kThinLine, kDot, kCircle, kTriangle, kBox };
  Kind kind = Kind::kLine;
  std::string colour, dashes = "1";
  std::string text;  // markup
};

// Orders of a mesh other than that of the phase.
inline constexpr const char* kOtherMeshColour = "#d070ff";
inline constexpr const char* kOtherMeshDashes = "(9,6)";

// A line over a map of two axes.
struct MapLine {
  std::vector<std::pair<double, double>> points;  // in the axes' units
  std::string colour, dashes;
  std::string label;  // markup, at the last point in the picture; may be empty
  double width = 1.6;
};

// The band of tolerances around a curve.
struct CurveBand {
  ResultMap low, high;
  std::optional<ResultMap> median;
  std::string meaning;  // "percentiles 5 to 95"
};

// A map with its axes sorted upwards, and what the labels say beside it.
struct Picture {
  ResultMap map;
  MissingPoints missing;
  std::string title;
  std::string remark;                  // such as "b = 0.7"; may be empty
  std::string settings;                // of the study, as TOML
  std::optional<CurveBand> band = {};  // of a curve alone
  // For a map of two axes: what is plotted over it, what the key says of that, and markup in place
  // of the usual label of the bar.
  std::vector<MapLine> lines = {};
  std::vector<KeyEntry> key = {};
  std::string bar_label = {};
};

// A script without the lines that choose the terminal, and the binary files that it reads: `data`,
// and files.'-missing.dat'.
struct PlotScript {
  std::string before;  // plots rasters of points, ahead of the picture
  std::string text, data, missing;
  double height = 0.0;  // of the picture, in points
};

PlotScript plot_heat_map(const Page& page, const Picture& picture);

// Markup of the lines above a picture: the title, and below it smaller, unless the picture is for
// print, what is shown; then where. What is empty is left out.
std::vector<std::string> heading_lines(const Page& page, const std::string& title,
                                       const std::string& subtitle, const std::string& remark);
double heading_height(const Page& page, const std::vector<std::string>& lines);
// What they need between a frame and the page's top edge, a margin included.
double head_room(const Page& page, const std::vector<std::string>& lines);
// "set label" lines, above a frame.
std::string plot_heading(const Page& page, const std::vector<std::string>& lines,
                         const Frame& frame, double height);

// The key, at the foot of a picture.
double key_height(const Page& page, const std::vector<KeyEntry>& entries);
std::string plot_key(const Page& page, const std::vector<KeyEntry>& entries, double height);

struct PanelAxis {
  std::vector<std::string> label;  // markup, in lines
  AxisRange range;
  const ClassScale* classes = nullptr;  // in place of numbers
  bool has_numbers = true;
};
// What a frame needs on its left for numbers and label of an axis of this length.
double left_room(const Page& page, const PanelAxis& y, double length);
// The same below it.
double bottom_room(const Page& page, const PanelAxis& x);
// What it needs above and on its right, beside what stands there: for half of the last number.
double edge_room(const Page& page);
// "reset" and "set" lines: place, ranges, tics and labels. The axes x2 and y2 go from 0 to 1.
std::string panel_lines(const Page& page, const Frame& frame, double height, const PanelAxis& x,
                        const PanelAxis& y);
// Throws InputError when the page leaves the frame no room.
void ensure_room(const Frame& frame, const Page& page);
// A light grid behind curves.
std::string grid_lines();

// In one line, or in two where that is longer than `length`.
std::vector<std::string> label_lines(const Page& page, const std::string& markup, double length);

// Limits of a style over an axis's own ends, from edge to edge of the cells. Throws InputError, by
// the option's name, when they do not fit.
AxisRange axis_range(const ResultAxis& axis, const Limits& limits, const std::string& option);
// What the y axis is of: the map, or a sampled state.
ChannelInfo shown_by(const Picture& picture);
// What a picture shows, in words.
std::string meaning_of(const Picture& picture);

// Adds marks below a curve where there is no value: what follows "plot CURVE", and their places.
void add_missing_marks(const Picture& picture, const std::string& colour, PlotScript* script);

// The records of numbers that are appended to the script's data next, as "plot" names them.
std::string next_records(const PlotScript& script, std::size_t count, std::size_t columns);
// Binary numbers as gnuplot reads them with format='%double'.
void append_numbers(std::initializer_list<double> numbers, std::string* out);

}  // namespace gearsweep
