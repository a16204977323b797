#include "borders/map_borders.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace gearsweep {
namespace {

// An edge in half pixels: where its middle is.
using Middle = std::pair<long, long>;
// Edges of the same key may hang together: the labels, and the contacts.
using Key = std::array<long, 4>;
using KeyOf = std::function<std::optional<Key>(std::size_t, std::size_t)>;

}  // namespace

int PeriodPixels::label(std::size_t pixel) const {
  const double value = period[pixel];
  return value >= 1.0 && value <= kLongestBorderPeriod ? static_cast<int>(std::lround(value)) : 0;
}

PlanePlace PeriodPixels::place(std::size_t pixel) const {
  return {axes[0][pixel % columns()], axes[1][pixel / columns()]};
}

namespace {

std::vector<MapBorder> borders_by(const KeyOf& key_of, const PeriodPixels& pixels,
                                  std::size_t min_edges) {
  const std::size_t nx = pixels.columns(), ny = pixels.axes[1].size();
  std::map<Key, std::map<Middle, BorderEdge>> all;
  const auto look = [&](std::size_t a, std::size_t b) {
    const std::optional<Key> key = key_of(a, b);
    if (!key) return;
    const auto middle = [&](std::size_t (*part)(std::size_t, std::size_t)) {
      return static_cast<long>(part(a, nx) + part(b, nx));
    };
    const Middle at = {middle([](std::size_t p, std::size_t n) { return p % n; }),
                       middle([](std::size_t p, std::size_t n) { return p / n; })};
    all[*key].emplace(at, BorderEdge{{a, b}});
  };
  for (std::size_t y = 0; y < ny; ++y) {
    for (std::size_t x = 0; x < nx; ++x) {
      const std::size_t pixel = y * nx + x;
      if (x + 1 < nx) look(pixel, pixel + 1);
      if (y + 1 < ny) look(pixel, pixel + nx);
    }
  }
  std::vector<MapBorder> out;
  for (auto& [key, edges] : all) {
    while (!edges.empty()) {
      MapBorder border{{static_cast<int>(key[0]), static_cast<int>(key[1])}, {}};
      std::vector<Middle> open = {edges.begin()->first};
      border.edges.push_back(edges.begin()->second);
      edges.erase(edges.begin());
      while (!open.empty()) {
        const Middle at = open.back();
        open.pop_back();
        for (long dy = -2; dy <= 2; ++dy) {
          for (long dx = -2; dx <= 2; ++dx) {
            const auto found = edges.find({at.first + dx, at.second + dy});
            if (found == edges.end()) continue;
            open.push_back(found->first);
            border.edges.push_back(found->second);
            edges.erase(found);
          }
        }
      }
      if (border.edges.size() >= min_edges) out.push_back(std::move(border));
    }
  }
  std::ranges::stable_sort(
      out, [](const MapBorder& a, const MapBorder& b) { return a.edges.size() > b.edges.size(); });
  return out;
}

}  // namespace

std::vector<MapBorder> find_map_borders(const PeriodPixels& pixels, std::size_t min_edges) {
  const auto key_of = [&](std::size_t a, std::size_t b) -> std::optional<Key> {
    const auto [low, high] = std::minmax({pixels.label(a), pixels.label(b)});
    if (low == high) return std::nullopt;
    return Key{low, high, 0, 0};
  };
  return borders_by(key_of, pixels, min_edges);
}

std::vector<MapBorder> find_contact_borders(const PeriodPixels& pixels, std::size_t min_edges) {
  if (pixels.contact.empty()) return {};
  const auto key_of = [&](std::size_t a, std::size_t b) -> std::optional<Key> {
    const int label = pixels.label(a);
    const double one = pixels.contact[a], other = pixels.contact[b];
    if (label == 0 || label != pixels.label(b) || !std::isfinite(one) || !std::isfinite(other)) {
      return std::nullopt;
    }
    // Impacts a period, of all periods of the orbit.
    const auto [low, high] = std::minmax({std::lround(one * label), std::lround(other * label)});
    if (low == high) return std::nullopt;
    return Key{label, label, low, high};
  };
  return borders_by(key_of, pixels, min_edges);
}

}  // namespace gearsweep
