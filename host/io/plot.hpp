// Pictures of result files, drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace gearsweep {

struct PlotRequest {
  std::string result_path;
  // As for ResultFile::read; empty: along one axis `poincare`, where the file has it, otherwise the
  // first map. `poincare` means its first state; over two axes a quantity of several numbers means
  // the first of them.
  std::string quantity;
  std::string output_path;  // ends in .png, .svg or .pdf
  // Ends in .gp when not empty: the gnuplot script is kept there, and its data beside it under
  // the same name with the endings .dat and -missing.dat. It runs from any folder.
  std::string script_path;
  // Axis name and value: draws the other axis alone, at the nearest value of this one.
  std::optional<std::pair<std::string, double>> at;
};

// Throws InputError when no picture can be put there (the ending or the place will not do),
// RunError when gnuplot is not installed.
void ensure_plottable(const std::string& output_path);

// Draws a heat map of two axes, curves of one, or a bifurcation diagram of `poincare` over one.
// The picture appears whole or not at all. Throws InputError when the request does not fit the file
// or cannot be written, RunError when gnuplot is not installed or fails.
void plot_map(const PlotRequest& request);

}  // namespace gearsweep
