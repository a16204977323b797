// Pictures of result files and of traces, plotted by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plot/style.hpp"

namespace gearsweep {

struct PlotRequest {
  // Result files, or files of traces. Several are laid over one another.
  std::vector<std::string> paths = {};
  // For maps as ResultFile::read takes it; empty: along one axis `poincare`, where the file has it,
  // otherwise the first map. `poincare` means its first state; over two axes, and laid over one
  // another, a quantity of several numbers means the first of them. Over one axis several,
  // separated by commas, stand above one another. Of traces: `time` (the default), `phase`,
  // `section`, `spectrum` or `force`, and after a colon what of: "time:v3"; "phase:x3" is x3
  // against v3, "phase:x1:x3" two channels of choice. Without, it is of the model's first state,
  // `force` of the force between the teeth. Of an order map: what stands upright, `frequency` (the
  // default) or `order`.
  std::string quantity = {};
  std::string output_path = {};  // ends in .png, .svg, .pdf or .tex
  // Ends in .gp when not empty: the gnuplot script is kept there, and its data beside it under
  // the same name with the endings .dat and -missing.dat. It runs from any folder, and takes the
  // picture and the data as arguments: gnuplot -c SCRIPT PICTURE DATA.
  std::string script_path = {};
  // Axis name and value: plots the other axis alone, at the nearest value of this one.
  std::optional<std::pair<std::string, double>> at = {};
  // Only so many last forcing periods of traces; without, 10 in `time` and `force`, else all.
  std::optional<std::size_t> periods = {};
  std::optional<double> orders = {};  // the highest of `spectrum`; without, 10; or of an order map
  // Orders that an order map has as lines: "1,2,1/2", "none"; empty: 1 to 4.
  std::string rays = {};
  std::string curves_path = {};  // of border curves, to be plotted over a map of two axes
  PlotStyle style = {};
};

// Throws InputError when no picture can be put there (the ending or the place will not do),
// RunError when gnuplot is not installed.
void ensure_plottable(const std::string& output_path);

// From maps it plots a heat map of two axes, curves of one, or a bifurcation diagram of `poincare`
// over one; from traces what the quantity says. The picture appears whole or not at all; with a
// .tex comes a .pdf of the same name, which it includes. Throws InputError when the request does
// not fit the files or cannot be written, RunError when gnuplot is not installed or fails.
void plot_files(const PlotRequest& request);

}  // namespace gearsweep
