// One picture and the gnuplot script that draws it. Private to this folder.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/result_file.hpp"

namespace gearsweep {

// Points without a value.
struct MissingPoints {
  std::vector<bool> mask;  // [point]
  std::string note;        // "no value at 12 points: diverged"; empty when there are none
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
};

PlotScript draw_heat_map(const Picture& picture);
// One curve for each part.
PlotScript draw_curve(const Picture& picture);
// Of the samples of one state.
PlotScript draw_bifurcation(const Picture& picture);

// "set" lines that all pictures share: title, frame, key.
std::string frame(const Picture& picture);
// "set" lines of the label, range (to the cells' edges) and scale of an axis; letter: x or y.
std::string axis_lines(char letter, const ResultAxis& axis);

// Marks below a curve where there is no value: what follows "plot CURVE". Empty when there is none.
std::string missing_marks(const Picture& picture);
// The numbers that they read.
std::string missing_places(const Picture& picture);

// Binary numbers as gnuplot reads them with format='%double'.
void append_numbers(std::initializer_list<double> numbers, std::string* out);

}  // namespace gearsweep
