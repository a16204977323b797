// One picture and the gnuplot script that draws it. Private to this folder.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/plot_scale.hpp"
#include "io/result_file.hpp"

namespace gearsweep {

// Points without a value.
struct MissingPoints {
  std::vector<bool> mask;  // [point]
  std::string note;        // "diverged at 12 of 100 points"; empty when there are none
};

// A map with its axes sorted upwards, and what the labels say beside it.
struct Picture {
  ResultMap map;
  MissingPoints missing;
  std::string title;
  std::string remark;  // such as "b = 0.7"; may be empty
};

// A script without the lines that choose the terminal, and the binary files that it reads as
// files.'.dat' and files.'-missing.dat'.
struct PlotScript {
  std::string text, data, missing;
  bool for_column = false;  // letters that are legible where the picture is 85 mm wide
  double height = 0.75;     // of the picture, in widths
};

PlotScript draw_heat_map(const Picture& picture);
// One curve for each part.
PlotScript draw_curve(const Picture& picture);
// Of the samples of one state.
PlotScript draw_bifurcation(const Picture& picture);

// The curves without title, horizontal axis and key: range, label (markup) and the command "plot",
// to which more may be added.
void add_curve(const Picture& picture, const std::string& label, PlotScript* script);
// What the key says of a map of several parts, as elements of "plot"; empty of one part.
std::vector<std::string> part_entries(const ResultMap& map);
// The samples of one state as dots, as an element of "plot".
void add_dots(const ResultMap& map, const ValueRange& range, const std::string& colour,
              PlotScript* script);

// Markup: the study's title, below it smaller what is shown and where; what is empty is left out.
std::vector<std::string> title_lines(const std::string& title, const std::string& subtitle,
                                     const std::string& remark, bool for_column);
std::string set_title(const std::vector<std::string>& lines);
// "set" lines of a key of these entries in large letters, below the picture in as many columns as
// their length allows.
std::string key_below(const std::vector<std::string>& entries);
// What the y axis is of: the map, or a sampled state.
ChannelInfo shown_by(const Picture& picture);
// What a picture shows, in words.
std::string meaning_of(const Picture& picture);
// "set" lines that all pictures of one map share: title, frame, key.
std::string frame(const Picture& picture);
// "set" lines of the label, range (to the cells' edges) and scale of an axis; letter: x or y.
std::string axis_lines(char letter, const ResultAxis& axis);

// Adds marks below a curve where there is no value: what follows "plot CURVE", and their places.
// The key calls them by the picture's note.
void add_missing_marks(const Picture& picture, const std::string& colour, PlotScript* script);

// The records of numbers that are appended to the script's data next, as "plot" names them.
std::string next_records(const PlotScript& script, std::size_t count, std::size_t columns);
// Binary numbers as gnuplot reads them with format='%double'.
void append_numbers(std::initializer_list<double> numbers, std::string* out);

}  // namespace gearsweep
