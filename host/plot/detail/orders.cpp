// The order map: spectra over an axis as a map, with the natural frequencies and the orders of the
// excitation as lines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "model/error.hpp"
#include "model/names.hpp"
#include "orders/spectrum.hpp"
#include "plot/detail/picture.hpp"
#include "plot/detail/sources.hpp"
#include "plot/detail/text.hpp"
#include "result/order_dataset.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

constexpr const char* kNaturalColour = "#ffffff";
constexpr const char* kRayColour = "#ff8c5a";
// So that a ray does not cover the line of the spectrum that it points at.
constexpr const char* kRayDashes = "(3,9)";

// A multiple of the forcing frequency, as it was asked for: "1/2", or of a second mesh: "2:second".
struct Ray {
  double order = 0.0;
  std::string name;
  std::size_t mesh = 0;
};

double ray_number(const std::string& text) {
  try {
    std::size_t used = 0;
    const double number = std::stod(text, &used);
    if (used == text.size() && number > 0.0 && std::isfinite(number)) return number;
  } catch (const std::exception&) {
    // Falls through to the one message.
  }
  throw InputError(fmt::format(
      "--rays: '{}' is no order; give multiples of the mesh frequency, as in 1,2,1/2", text));
}

// The mesh of this name. Throws InputError where there is none.
std::size_t mesh_of_ray(const std::string& ray, const std::string& name,
                        const std::vector<ExcitingMesh>& meshes) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].name == name && !name.empty()) return i;
    if (!meshes[i].name.empty()) names.push_back(meshes[i].name);
  }
  throw InputError(
      names.empty()
          ? fmt::format("--rays: '{}': this order map is of one mesh; leave out ':{}'", ray, name)
          : fmt::format("--rays: '{}': the meshes are {}", ray, fmt::join(names, " and ")));
}

// Orders 1 to 4 of one mesh, and as many of each of two.
std::string usual_rays(const std::vector<ExcitingMesh>& meshes) {
  std::string rays = "1,2,3,4";
  if (meshes.size() < 2) return rays;
  for (int order = 1; order <= 4; ++order) {
    rays += fmt::format(",{}:{}", order, meshes.back().name);
  }
  return rays;
}

std::vector<Ray> rays_of(const PlotRequest& request, const std::vector<ExcitingMesh>& meshes) {
  std::vector<Ray> rays;
  constexpr std::size_t kMost = 40;
  if (request.rays == "none") return rays;
  for (const std::string& ray :
       split(request.rays.empty() ? usual_rays(meshes) : request.rays, ',')) {
    const std::size_t colon = ray.find(':');
    const std::string name = ray.substr(0, colon);
    const std::size_t mesh =
        colon == std::string::npos ? 0 : mesh_of_ray(ray, ray.substr(colon + 1), meshes);
    const std::size_t slash = name.find('/');
    const double above = ray_number(name.substr(0, slash));
    const double below = slash == std::string::npos ? 1.0 : ray_number(name.substr(slash + 1));
    rays.push_back({above / below * meshes[mesh].order, name, mesh});
  }
  if (rays.size() > kMost) throw InputError(fmt::format("--rays: at most {} orders", kMost));
  return rays;
}

// What stands on the vertical axis: orders, or frequencies in this unit.
struct Upright {
  bool is_order = false;
  double scale = 1.0;  // of a frequency
  ResultAxis axis;

  double place(double order, double forcing) const {
    return is_order ? order : scale * order * forcing;
  }
  double place_of_frequency(double frequency, double forcing) const {
    return is_order ? frequency / forcing : scale * frequency;
  }
};

Upright upright_of(const StoredOrders& stored, const PlotRequest& request) {
  Upright upright;
  upright.is_order = request.quantity == "order";
  if (!request.quantity.empty() && !upright.is_order && request.quantity != "frequency") {
    throw InputError(
        fmt::format("-q {}: an order map is drawn over 'frequency' (the default) or over 'order'",
                    request.quantity));
  }
  constexpr double kUsualOrder = 4.0;
  const double max_order = std::min(request.orders.value_or(kUsualOrder), stored.orders.back());
  if (upright.is_order) {
    upright.axis.name = "order";
    upright.axis.unit = "1";
    upright.axis.meaning = stored.order_of + " order" +
                           (stored.meshes.size() < 2 ? "" : " of " + stored.meshes.front().name);
    for (const double order : stored.orders) {
      if (order <= max_order) upright.axis.values.push_back(order);
    }
    return upright;
  }
  upright.axis.name = "frequency";
  upright.axis.unit = stored.frequency_unit;
  if (request.style.is_si) {
    upright.scale = hertz_per_unit(stored.scales);
    upright.axis.unit = "Hz";
  }
  upright.axis.meaning = "frequency";
  constexpr std::size_t kOrderRows = 480;
  const double fastest = *std::max_element(stored.forcing.begin(), stored.forcing.end());
  double highest = upright.place(max_order, fastest);
  // The natural frequencies are seen, unless the orders were asked for.
  for (const std::vector<double>& mode : stored.frequencies) {
    constexpr double kRoom = 1.1;
    if (!request.orders) highest = std::max(highest, kRoom * upright.scale * mode.front());
  }
  const double top = request.style.yrange.max.value_or(highest);
  for (std::size_t i = 0; i < kOrderRows; ++i) {
    upright.axis.values.push_back(top * (static_cast<double>(i) + 0.5) / kOrderRows);
  }
  return upright;
}

// The largest amplitude of the orders that lie in a cell, at least of the nearest one; NaN above
// the last.
double amplitude_in(const StoredOrders& stored, std::size_t point, double from, double to) {
  const std::vector<double>& orders = stored.orders;
  const double step = orders[1] - orders[0];
  const auto nearest = [&](double order) { return std::round((order - orders[0]) / step); };
  const double last = static_cast<double>(orders.size() - 1);
  const double low = std::max(0.0, nearest(from)), high = nearest(to);
  if (low > last) return std::nan("");
  double found = 0.0;
  for (double bin = low; bin <= std::min(high, last); bin += 1.0) {
    const double own = stored.amplitude[point * orders.size() + static_cast<std::size_t>(bin)];
    if (std::isnan(own)) return own;
    found = std::max(found, own);
  }
  return found;
}

// In decibels, [row][point].
std::vector<double> levels_of(const StoredOrders& stored, const Upright& upright) {
  const std::size_t points = stored.axis.values.size();
  const std::vector<double> edges = cell_edges(upright.axis);
  std::vector<double> levels;
  for (std::size_t row = 0; row < upright.axis.values.size(); ++row) {
    for (std::size_t point = 0; point < points; ++point) {
      const double unit = upright.is_order ? 1.0 : upright.scale * stored.forcing[point];
      const bool is_bin = upright.is_order;
      const double from = is_bin ? upright.axis.values[row] : edges[row] / unit;
      const double to = is_bin ? from : edges[row + 1] / unit;
      const double amplitude = amplitude_in(stored, point, from, to);
      levels.push_back(amplitude > 0.0    ? decibels(amplitude)
                       : amplitude == 0.0 ? -1e3
                                          : std::nan(""));
    }
  }
  return levels;
}

// The colours cover so many decibels below the largest, unless ends were asked for.
Limits colour_limits(const std::vector<double>& levels, const Limits& asked) {
  constexpr double kDepth = 80.0, kRound = 10.0;
  double max = -1e3;
  for (const double level : levels) {
    if (std::isfinite(level)) max = std::max(max, level);
  }
  Limits limits = asked;
  if (!limits.max) limits.max = kRound * std::ceil(max / kRound);
  if (!limits.min) limits.min = *limits.max - kDepth;
  return limits;
}

void add_lines(const StoredOrders& stored, const Upright& upright, const std::vector<Ray>& rays,
               Picture* picture) {
  const std::vector<double>& x = stored.axis.values;
  std::vector<double> known;
  for (const std::vector<double>& mode : stored.frequencies) {
    // Equal modes are one line.
    const auto is_same = [&](double other) {
      return std::abs(other - mode.front()) < 1e-6 * other;
    };
    if (std::any_of(known.begin(), known.end(), is_same)) continue;
    known.push_back(mode.front());
    MapLine line{{}, kNaturalColour, "2", ""};
    for (std::size_t i = 0; i < x.size(); ++i) {
      line.points.emplace_back(x[i], upright.place_of_frequency(mode[i], stored.forcing[i]));
    }
    picture->lines.push_back(std::move(line));
  }
  for (const Ray& ray : rays) {
    MapLine line{{},
                 ray.mesh == 0 ? kRayColour : kOtherMeshColour,
                 ray.mesh == 0 ? kRayDashes : kOtherMeshDashes,
                 literal(ray.name)};
    for (std::size_t i = 0; i < x.size(); ++i) {
      line.points.emplace_back(x[i], upright.place(ray.order, stored.forcing[i]));
    }
    picture->lines.push_back(std::move(line));
  }
  if (!known.empty()) {
    picture->key.push_back({KeyEntry::Kind::kLine, "#777777", "2", "natural frequencies"});
  }
  for (std::size_t mesh = 0; mesh < stored.meshes.size(); ++mesh) {
    if (std::ranges::find(rays, mesh, &Ray::mesh) == rays.end()) continue;
    const bool is_one = stored.meshes.size() == 1;
    picture->key.push_back({KeyEntry::Kind::kLine, mesh == 0 ? kRayColour : kOtherMeshColour,
                            mesh == 0 ? kRayDashes : kOtherMeshDashes,
                            is_one ? literal(stored.order_of) + " orders"
                                   : "orders of " + literal(stored.meshes[mesh].name)});
  }
}

}  // namespace

PlotScript plot_orders(const PlotRequest& request) {
  if (request.paths.size() > 1) {
    throw InputError("an order map fills its picture; draw one file at a time");
  }
  if (request.at || request.periods) {
    throw InputError(
        "--at and --periods do not concern an order map; 'gearsweep orders' takes --at and "
        "--record");
  }
  for (const char* option : {"log", "contours", "legend"}) {
    request.style.refuse(option, "an order map is in decibels");
  }
  StoredOrders stored = read_orders(request.paths.front());
  Picture picture;
  ResultMap& map = picture.map;
  map.axes = {stored.axis};
  std::string unit = stored.channel.unit;
  if (request.style.is_si) {
    ensure_scales(stored.scales, request.paths.front());
    const SiUnit si = shown_unit(unit, stored.scales);
    if (si.scale > 0.0) {
      unit = si.name;
      for (double& amplitude : stored.amplitude) amplitude *= si.scale;
    }
  }
  const Upright upright = upright_of(stored, request);
  map.axes.push_back(upright.axis);
  map.values = levels_of(stored, upright);
  PlotStyle style = request.style;
  style.range = colour_limits(map.values, style.range);
  for (double& level : map.values) level = std::max(level, *style.range.min);
  if (style.colormap.empty()) style.colormap = "viridis";
  style.is_log = false;
  style.contours = {};
  map.name = stored.channel.name;
  map.unit = "1";
  map.meaning = stored.channel.meaning;
  picture.bar_label = fmt::format("amplitude of {} (dB re 1{})",
                                  quantity_label(stored.channel.name, "1", request.style.words),
                                  unit == "1" ? "" : " " + typeset(unit));
  picture.title = stored.title;
  picture.settings = stored.settings;
  add_lines(stored, upright, rays_of(request, stored.meshes), &picture);
  map.axes.front() = stored.axis;
  if (request.style.is_si) {
    const SiUnit si = shown_unit(stored.axis.unit, stored.scales);
    if (si.scale > 0.0) {
      ResultAxis& axis = map.axes.front();
      for (double& value : axis.values) value *= si.scale;
      axis.unit = si.name;
      if (!si.axis_meaning.empty()) axis.meaning = si.axis_meaning;
      for (MapLine& line : picture.lines) {
        for (auto& [x, y] : line.points) x *= si.scale;
      }
    }
  }
  return plot_heat_map(Page(style, picture_format(request.output_path), usual_width(request)),
                       picture);
}

}  // namespace gearsweep
