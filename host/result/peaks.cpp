#include "result/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearsweep {
namespace {

class Grid {
 public:
  explicit Grid(const ResultMap& map) {
    for (const ResultAxis& axis : map.axes) {
      sizes_.push_back(axis.values.size());
      is_list_.push_back(axis.is_list());
    }
  }

  std::vector<std::size_t> places(std::size_t point) const {
    std::vector<std::size_t> places;
    for (const std::size_t size : sizes_) {
      places.push_back(point % size);
      point /= size;
    }
    return places;
  }

  // Calls visit(neighbour) for each point whose place differs by at most one on each axis. Points
  // of a list have no neighbours along it.
  template <class Visit>
  void neighbours(std::size_t point, const Visit& visit) const {
    visit_from(places(point), 0, 1, 0, point, visit);
  }

  bool is_at_edge(const std::vector<std::size_t>& places) const {
    for (std::size_t axis = 0; axis < sizes_.size(); ++axis) {
      const bool is_end = places[axis] == 0 || places[axis] + 1 == sizes_[axis];
      if (is_end && sizes_[axis] > 1 && !is_list_[axis]) return true;
    }
    return false;
  }

 private:
  template <class Visit>
  void visit_from(const std::vector<std::size_t>& places, std::size_t axis, std::size_t stride,
                  std::size_t at, std::size_t point, const Visit& visit) const {
    if (axis == sizes_.size()) {
      if (at != point) visit(at);
      return;
    }
    const std::size_t reach = is_list_[axis] ? 0 : 1;
    const std::size_t first = places[axis] - std::min(places[axis], reach);
    const std::size_t last = std::min(places[axis] + reach, sizes_[axis] - 1);
    for (std::size_t place = first; place <= last; ++place) {
      visit_from(places, axis + 1, stride * sizes_[axis], at + place * stride, point, visit);
    }
  }

  std::vector<std::size_t> sizes_;
  std::vector<bool> is_list_;
};

// The points of equal value that hang together with `first`, which `seen` then has; nothing when a
// neighbour exceeds them.
std::vector<std::size_t> plateau_from(const Grid& grid, const std::vector<double>& heights,
                                      std::size_t first, std::vector<bool>* seen) {
  std::vector<std::size_t> plateau = {first};
  (*seen)[first] = true;
  bool is_exceeded = false;
  for (std::size_t i = 0; i < plateau.size(); ++i) {
    grid.neighbours(plateau[i], [&](std::size_t neighbour) {
      if (heights[neighbour] > heights[first]) is_exceeded = true;
      if (heights[neighbour] == heights[first] && !(*seen)[neighbour]) {
        (*seen)[neighbour] = true;
        plateau.push_back(neighbour);
      }
    });
  }
  if (is_exceeded) plateau.clear();
  return plateau;
}

// The one of the points that is nearest to the mean of their places; the first of equally near
// ones.
std::size_t middle_of(const Grid& grid, std::vector<std::size_t> points) {
  if (points.size() == 1) return points.front();
  std::sort(points.begin(), points.end());
  std::vector<double> mean(grid.places(points.front()).size(), 0.0);
  for (const std::size_t point : points) {
    const std::vector<std::size_t> places = grid.places(point);
    for (std::size_t axis = 0; axis < mean.size(); ++axis) {
      mean[axis] += static_cast<double>(places[axis]) / static_cast<double>(points.size());
    }
  }
  std::size_t middle = points.front();
  double min = std::numeric_limits<double>::infinity();
  for (const std::size_t point : points) {
    const std::vector<std::size_t> places = grid.places(point);
    double distance = 0.0;
    for (std::size_t axis = 0; axis < mean.size(); ++axis) {
      distance += std::pow(static_cast<double>(places[axis]) - mean[axis], 2);
    }
    // Rounding of the mean decides between no two points.
    if (distance < min - 1e-9) {
      min = distance;
      middle = point;
    }
  }
  return middle;
}

bool are_apart(const ResultMap& map, const Peak& a, const Peak& b, double apart) {
  for (std::size_t axis = 0; axis < map.axes.size(); ++axis) {
    const std::size_t low = std::min(a.places[axis], b.places[axis]);
    const std::size_t high = std::max(a.places[axis], b.places[axis]);
    if (high - low >= steps_apart(map.axes[axis], apart)) return true;
  }
  return false;
}

}  // namespace

std::size_t steps_apart(const ResultAxis& axis, double apart) {
  if (axis.is_list()) return 1;
  const double steps = apart * static_cast<double>(axis.values.size());
  return std::max<std::size_t>(2, static_cast<std::size_t>(std::floor(steps)) + 1);
}

std::vector<Peak> find_peaks(const ResultMap& map, const PeakSearch& search) {
  const Grid grid(map);
  std::vector<double> heights = map.values;
  if (search.smallest) {
    for (double& height : heights) height = -height;
  }
  std::vector<Peak> peaks;
  std::vector<bool> seen(heights.size(), false);
  for (std::size_t point = 0; point < heights.size(); ++point) {
    if (seen[point] || std::isnan(heights[point])) continue;
    const std::vector<std::size_t> plateau = plateau_from(grid, heights, point, &seen);
    if (plateau.empty()) continue;
    const std::size_t middle = middle_of(grid, plateau);
    const std::vector<std::size_t> places = grid.places(middle);
    peaks.push_back({middle, places, map.values[middle], grid.is_at_edge(places)});
  }
  std::sort(peaks.begin(), peaks.end(), [&](const Peak& a, const Peak& b) {
    if (heights[a.point] != heights[b.point]) return heights[a.point] > heights[b.point];
    return a.point < b.point;
  });
  std::vector<Peak> taken;
  for (const Peak& peak : peaks) {
    if (taken.size() == search.count) break;
    const bool is_apart = std::all_of(taken.begin(), taken.end(), [&](const Peak& before) {
      return are_apart(map, peak, before, search.apart);
    });
    if (is_apart) taken.push_back(peak);
  }
  return taken;
}

}  // namespace gearsweep
