#include "plot/detail/contours.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace gearsweep {
namespace {

double place_on(const ResultAxis& axis, std::size_t index, double share) {
  return between(axis.values[index], axis.values[index + 1], share, axis.logarithmic);
}

}  // namespace

// Each square between four points is cut into four triangles around the mean of its corners: no
// corner case is ambiguous.
std::vector<ContourPiece> contour_pieces(const ResultMap& map, double level) {
  const ResultAxis& x = map.axes[0];
  const ResultAxis& y = map.axes[1];
  const std::size_t nx = x.values.size(), ny = y.values.size();
  struct Corner {
    double u = 0.0, v = 0.0, value = 0.0;  // u, v: shares of the square
  };
  std::vector<ContourPiece> pieces;
  for (std::size_t iy = 0; iy + 1 < ny; ++iy) {
    for (std::size_t ix = 0; ix + 1 < nx; ++ix) {
      const auto value = [&](std::size_t dx, std::size_t dy) {
        return map.values[(iy + dy) * nx + ix + dx];
      };
      const std::array<Corner, 4> corners = {{{0.0, 0.0, value(0, 0)},
                                              {1.0, 0.0, value(1, 0)},
                                              {1.0, 1.0, value(1, 1)},
                                              {0.0, 1.0, value(0, 1)}}};
      double mean = 0.0;
      for (const Corner& corner : corners) mean += 0.25 * corner.value;
      if (!std::isfinite(mean)) continue;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::array<Corner, 3> triangle = {
            {corners[i], corners[(i + 1) % 4], {0.5, 0.5, mean}}};
        std::array<std::pair<double, double>, 3> cuts;
        std::size_t count = 0;
        for (std::size_t side = 0; side < 3; ++side) {
          const Corner& a = triangle[side];
          const Corner& b = triangle[(side + 1) % 3];
          if ((a.value < level) == (b.value < level)) continue;
          const double share = (level - a.value) / (b.value - a.value);
          cuts[count++] = {a.u + share * (b.u - a.u), a.v + share * (b.v - a.v)};
        }
        if (count != 2) continue;
        pieces.push_back({place_on(x, ix, cuts[0].first), place_on(y, iy, cuts[0].second),
                          place_on(x, ix, cuts[1].first), place_on(y, iy, cuts[1].second)});
      }
    }
  }
  return pieces;
}

std::vector<double> contour_levels(const Contours& contours, const ValueRange& range, bool is_log) {
  if (contours.count == 0) return contours.levels;
  std::vector<double> levels;
  const auto parts = static_cast<double>(contours.count + 1);
  for (std::size_t i = 1; i <= contours.count; ++i) {
    const double share = static_cast<double>(i) / parts;
    levels.push_back(between(range.min, range.max, share, is_log));
  }
  return levels;
}

}  // namespace gearsweep
