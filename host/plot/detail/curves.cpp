#include "plot/detail/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/error.hpp"
#include "plot/curve_styles.hpp"
#include "plot/detail/text.hpp"
#include "result/border_file.hpp"
#include "result/border_plane.hpp"
#include "result/study_source.hpp"

namespace gearsweep {
namespace {

double largest(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) {
    if (std::abs(value) > std::abs(out)) out = value;
  }
  return out;
}

// What the units of a picture make of the file's numbers.
double scale_of(const ResultAxis& shown, const ResultAxis& own) {
  const double file = largest(own.values);
  return file == 0.0 ? 1.0 : largest(shown.values) / file;
}

}  // namespace

void add_curves(const std::string& path, const std::string& map_path, Picture* picture) {
  const StoredCurves stored = read_borders(path);
  const std::vector<ResultAxis>& axes = picture->map.axes;
  if (axes.size() != 2) throw InputError("--curves takes a map of two axes, without --at");
  if (stored.x != axes[0].name || stored.y != axes[1].name) {
    throw InputError(
        fmt::format("--curves {}: its curves are over {} and {}, the map is over {} and {}", path,
                    stored.x, stored.y, axes[0].name, axes[1].name));
  }
  require_plane("--curves " + path, read_border_study(path, stored), read_result_study(map_path));
  const std::vector<ResultAxis> own = ResultFile(map_path).axes();
  const double x = scale_of(axes[0], own[0]), y = scale_of(axes[1], own[1]);
  std::vector<MapLine> lines;
  for (const CurveStyle& style : kCurveStyles) {
    bool is_there = false;
    for (const StoredCurve& curve : stored.curves) {
      if (curve.kind != style.kind) continue;
      is_there = true;
      for (const CurveStretch& stretch : stretches_of(curve)) {
        MapLine line{
            {}, style.colour, style.dashes, "", stretch.is_stable ? kCurveWidth : kThinCurveWidth};
        for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
          line.points.emplace_back(x * curve.places[i].first, y * curve.places[i].second);
        }
        if (stretch.is_stable) {
          MapLine rim = line;  // so that it is seen on any colour
          rim.colour = "#ffffff";
          rim.dashes = "1";
          rim.width = kCurveRimWidth;
          picture->lines.push_back(std::move(rim));
          lines.push_back(std::move(line));
        } else {
          line.dashes = "1";
          picture->lines.insert(picture->lines.begin(), std::move(line));
        }
      }
    }
    if (is_there) {
      picture->key.push_back({KeyEntry::Kind::kLine, style.colour, style.dashes, style.kind});
    }
  }
  picture->lines.insert(picture->lines.end(), lines.begin(), lines.end());
}

}  // namespace gearsweep
