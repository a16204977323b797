// Borders of a map: where neighbouring pixels differ in the period of their motion.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "borders/parameter_plane.hpp"

namespace gearsweep {

// The periods of a map, over two axes of one parameter each.
struct PeriodPixels {
  std::array<std::vector<double>, 2> axes;  // the values of x and y
  std::array<bool, 2> is_logarithmic{};
  std::vector<double> period;  // [iy * nx + ix]; no number: not periodic
  // The same of what the motion touches, as a class or a number of impacts a period; may be empty.
  std::vector<double> contact;

  std::size_t columns() const { return axes[0].size(); }
  // 0: the motion has no period, or a longer one than is looked at.
  int label(std::size_t pixel) const;
  PlanePlace place(std::size_t pixel) const;
};

// Periods that are looked at: up to this one.
inline constexpr int kLongestBorderPeriod = 16;

// Two neighbours of different periods.
struct BorderEdge {
  std::array<std::size_t, 2> pixels{};
};

// Edges that hang together, between the same two periods.
struct MapBorder {
  std::array<int, 2> labels{};  // the smaller first
  std::vector<BorderEdge> edges;
};

// The longest first; those of fewer edges are left out.
std::vector<MapBorder> find_map_borders(const PeriodPixels& pixels, std::size_t min_edges);
// The same between neighbours of one period that differ in the contact.
std::vector<MapBorder> find_contact_borders(const PeriodPixels& pixels, std::size_t min_edges);

}  // namespace gearsweep
