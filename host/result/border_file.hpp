// Files of border curves: NetCDF-4, curves as contiguous ragged arrays (as the CF conventions have
// them), with the special points and what parts the pixels of the map.
#pragma once

#include <complex>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "result/dataset.hpp"

namespace gearsweep {

struct BorderFindings;  // borders/border_search.hpp

// Along `point`, curve after curve: the two parameters, `state` (point, state) at phase 0,
// `multiplier_real` and `multiplier_imag` (point, multiplier), largest modulus first, `angle` of
// the critical multiplier, `stable`, `residual` of all equations in sizes of the states. Along
// `curve`: `curve_kind`, `curve_period` in forcing periods, `curve_points` (how many points it
// has), `curve_closed`, `curve_begins`, `curve_ends`, `curve_limit` of a grazing curve,
// `curve_step_error` in pixels, `curve_judged` and, along `parameter`, too, curve_gradient_NAME:
// how far the curve moves across itself there with a parameter. Along `special`: `special_kind`,
// `special_curve` and the two parameters as special_NAME. Along `border`: `border_period` (border,
// side), 0: none, `border_pairs`, and how many of these are `border_on_curve`, `border_basin`,
// `border_lost`, `border_unsettled`, `border_grazing`.
Dataset dataset_of(const BorderFindings& findings, const Provenance& provenance);

void write_borders(const BorderFindings& findings, const std::string& path,
                   const Provenance& provenance);

// The orbit that bifurcates at a point of a curve.
struct StoredOrbit {
  std::vector<double> state;  // at phase 0
  std::vector<std::complex<double>> multipliers;
  double angle = 0.0, residual = 0.0;
};

// A curve as a file has it.
struct StoredCurve {
  std::string kind;
  int period = 1;
  std::vector<std::pair<double, double>> places;  // x, y
  std::vector<bool> is_stable;                    // [place] a motion that settles bifurcates there
  std::vector<StoredOrbit> orbits;                // [place]
  std::string limit;                              // of a grazing curve
  double step_error = std::numeric_limits<double>::quiet_NaN();
};
struct StoredCurves {
  std::string x, y;                 // names of the parameters
  std::vector<std::string> states;  // names of the model's
  std::size_t steps = 0;            // of a forcing period, by which the points were solved
  std::vector<StoredCurve> curves;
  std::vector<std::pair<std::string, std::pair<double, double>>> special;  // kind and place
};

// Whether a NetCDF file is one of curves. Throws InputError when it is no NetCDF file.
bool holds_borders(const std::string& path);
// Throws InputError when the file holds no curves.
StoredCurves read_borders(const std::string& path);

// What such a file has, by name, where a program has it without the file.
struct BorderTable {
  struct Numbers {
    std::vector<std::size_t> shape;  // as many elements
    std::vector<double> elements;
  };

  std::map<std::string, std::string> notes;  // its attributes that are texts
  double steps = 0.0;                        // its attribute steps_per_period
  std::map<std::string, std::vector<std::string>> texts;
  std::map<std::string, Numbers> numbers;
};
// Throws InputError, which calls it `origin`, where a file of these would be refused.
StoredCurves read_borders(const BorderTable& table, const std::string& origin);

}  // namespace gearsweep
