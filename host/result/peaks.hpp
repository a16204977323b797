// The largest or smallest points of a map that do not belong to one and the same peak.
#pragma once

#include <cstddef>
#include <vector>

#include "result/result_file.hpp"

namespace gearsweep {

struct Peak {
  std::size_t point = 0;            // of the map
  std::vector<std::size_t> places;  // [axis] index into the axis's values
  double value = 0.0;
  bool at_edge = false;  // of the map: beyond it there may be more
};

struct PeakSearch {
  std::size_t count = 5;  // at most so many
  bool smallest = false;
  // Two peaks are further apart than this share of an axis's values, on one axis at least, and more
  // than one value.
  double apart = 0.05;
};

// The steps that two peaks are apart on an axis, at least.
std::size_t steps_apart(const ResultAxis& axis, double apart);

// Local extremes, the most extreme first: a point, or a plateau of equal points, that no neighbour
// on the grid (diagonals included) exceeds. Each is further away from those before it than `search`
// says. A plateau is told of by the one of its points that is nearest to its middle. Equal ones are
// in the order of the points; points without a value are no neighbours. `map` has one number for
// each point.
std::vector<Peak> find_peaks(const ResultMap& map, const PeakSearch& search);

}  // namespace gearsweep
