#include "plot/detail/contours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gearsweep {
namespace {

double place_on(const ResultAxis& axis, std::size_t index, double share) {
  return between(axis.values[index], axis.values[index + 1], share, axis.logarithmic);
}

// A place in the picture, whose sides go from 0 to 1.
struct Spot {
  double x = 0.0, y = 0.0;
};

double share_of(const AxisRange& range, double value) {
  if (!range.logarithmic) return (value - range.min) / (range.max - range.min);
  return std::log(value / range.min) / std::log(range.max / range.min);
}

// How far a place is from the frame and from all labels; a label is wider than it is high.
double room_at(const Spot& spot, const std::vector<Spot>& labels) {
  double room = std::min({spot.x, 1.0 - spot.x, 2.0 * spot.y, 2.0 * (1.0 - spot.y)});
  for (const Spot& label : labels) {
    room = std::min(room, std::hypot(spot.x - label.x, 2.0 * (spot.y - label.y)));
  }
  return room;
}

}  // namespace

std::string add_contours(const std::vector<Contour>& contours, PlotScript* script) {
  std::size_t count = 0;
  for (const Contour& contour : contours) count += contour.pieces.size();
  if (count == 0) return "";
  const std::string data = next_records(*script, count, 4);
  for (const Contour& contour : contours) {
    for (const ContourPiece& piece : contour.pieces) {
      append_numbers({piece.x1, piece.y1, piece.x2, piece.y2}, &script->data);
    }
  }
  const auto element = [&](double width, const char* colour) {
    return fmt::format(
        ", \\\n     {} using 1:2:($3-$1):($4-$2) with vectors nohead linewidth {} linecolor rgb "
        "'{}' notitle",
        data, width, colour);
  };
  return element(3.0, "#ffffff") + element(1.2, "#000000");
}

std::string contour_labels(const Page& page, const std::vector<Contour>& contours,
                           const AxisRange& x, const AxisRange& y) {
  constexpr double kLeast = 0.09;  // of the picture
  std::vector<Spot> labels;
  std::string text;
  for (const Contour& contour : contours) {
    const ContourPiece* best = nullptr;
    double most = kLeast;
    Spot place;
    for (const ContourPiece& piece : contour.pieces) {
      const Spot spot = {share_of(x, 0.5 * (piece.x1 + piece.x2)),
                         share_of(y, 0.5 * (piece.y1 + piece.y2))};
      const double room = room_at(spot, labels);
      if (!(room > most)) continue;
      most = room;
      best = &piece;
      place = spot;
    }
    if (best == nullptr) continue;
    labels.push_back(place);
    text += fmt::format("set label {} at graph {:.5f}, graph {:.5f} center front{}\n",
                        page.text(fmt::format("{{/*0.85 {:.4g}}}", contour.level)), place.x,
                        place.y, page.is_latex() ? "" : " boxed");
  }
  if (text.empty()) return "";
  return "set style textbox opaque noborder margins 0.4,0.3 fillcolor rgb '#ffffff'\n" + text;
}

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
