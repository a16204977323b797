#include "borders/graze_borders.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "borders/find_graze.hpp"
#include "borders/on_threads.hpp"

namespace gearsweep {
namespace {

constexpr double kNearStop = 0.02, kNearLost = 0.05, kNearContact = 0.5;  // GrazeSeed::near
constexpr double kBesidePair = 1.5;   // pixels from the middle of a pair
constexpr double kAtStop = 0.02;      // of the window: how far from a stop its graze may be
constexpr std::size_t kMinLost = 3;   // pairs of a border: worth a search
constexpr std::size_t kMaxSeeds = 4;  // of a border
constexpr std::size_t kLongest = 4;   // period: the host takes long for longer ones
// The same where an orbit is lost, and how many seeds a border has there.
constexpr std::size_t kLongestLost = 9, kMaxLost = 2;
constexpr std::size_t kMinLongLost = 20;  // pairs of a border: worth a search for longer periods
// A motion that settles comes up to a graze where it is so near, in pixels and in sizes of the
// states, and the graze's multipliers are hardly outside the unit circle.
constexpr double kUpToGraze = 0.05, kHardlyUnstable = 0.2;
constexpr double kAlready = 1.0;  // pixels: a graze so near to a stop is the one that is there

// Indices that lie evenly among so many.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> out;
  const std::size_t chosen = std::min(count, most);
  for (std::size_t i = 0; i < chosen; ++i) out.push_back((2 * i + 1) * count / (2 * chosen));
  return out;
}

}  // namespace

std::vector<BorderCurve> GrazeBorders::curves_of(const Search& search) const {
  std::vector<BorderCurve> out;
  if (known_->grazes_near(search.period, search.place, search.already)) return out;
  for (const Crossing& found : search.find()) {
    if (known_->has(*found.equations, found.point)) continue;
    out.push_back(follow_border(*found.equations, found.point));
  }
  return out;
}

void GrazeBorders::run(SearchStage stage, const std::vector<Search>& searches) {
  for_each_in_order(
      searches.size(), nullptr,
      [&](std::size_t i) {
        return record_->curves({stage, i}, [&] { return curves_of(searches[i]); });
      },
      [&](std::size_t i, std::vector<BorderCurve> curves) {
        const Search& search = searches[i];
        if (known_->grazes_near(search.period, search.place, search.already)) return;
        for (BorderCurve& curve : curves) known_->add(std::move(curve));
      });
}

void GrazeBorders::from_stops() {
  const std::vector<BorderCurve> curves = known_->curves();
  std::vector<Search> searches;
  for (const BorderCurve& curve : curves) {
    for (const BorderPoint& point : curve.stops) {
      if (curve.period > kLongest || !point.is_of_stable_motion()) continue;
      searches.push_back(
          {curve.period, point.place, kAlready, [&] { return beside_stop(curve, point); }});
    }
  }
  run(SearchStage::stops, searches);
}

std::vector<Crossing> GrazeBorders::beside_stop(const BorderCurve& curve,
                                                const BorderPoint& point) const {
  const Eigen::Index n = point.tangent.size();
  const GrazeSeed seed{{point.place, curve.period, point.state, curve.scale.sizes, {}},
                       {point.tangent[n - 2], point.tangent[n - 1]},
                       kNearStop};
  std::vector<Crossing> out;
  for (Crossing& found : find_grazes(plane_, host_, seed)) {
    double gone = 0.0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double way = (found.point.place[axis] - point.place[axis]) / plane_.range(axis);
      gone = std::hypot(gone, way);
    }
    if (gone <= kAtStop) out.push_back(std::move(found));
  }
  return out;
}

void GrazeBorders::follow(SearchStage stage, const std::vector<PairSeed>& seeds) {
  std::vector<Search> searches;
  for (const PairSeed& seed : seeds) {
    searches.push_back(
        {seed.orbit.period, seed.orbit.place, kHalfPixel, [&] { return between(seed); }});
  }
  run(stage, searches);
}

std::vector<Crossing> GrazeBorders::between(const PairSeed& seed) const {
  const PlanePlace there = pixels_.place(seed.to);
  GrazeSeed at{seed.orbit, {}, seed.near};
  const auto [first, second] = seed.edge.pixels;
  const PlanePlace from = pixels_.place(seed.to == first ? second : first);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    at.way[axis] = (there[axis] - from[axis]) / plane_.range(axis);
  }
  const PixelPlace middle = middle_of(pixels_, seed.edge);
  std::vector<Crossing> out;
  for (Crossing& found : find_grazes(plane_, host_, at)) {
    const PixelPlace place = pixel_place(pixels_, found.point.place);
    const double apart = std::hypot(place[0] - middle[0], place[1] - middle[1]);
    const bool settles = found.point.is_of_stable_motion() || comes_up_to(seed.orbit, found.point);
    if (apart <= kBesidePair && settles) out.push_back(std::move(found));
  }
  return out;
}

bool GrazeBorders::comes_up_to(const HeldOrbit& orbit, const BorderPoint& graze) const {
  const PixelPlace here = pixel_place(pixels_, orbit.place),
                   there = pixel_place(pixels_, graze.place);
  const double far = (graze.state - orbit.state).cwiseQuotient(orbit.sizes).cwiseAbs().maxCoeff();
  return std::hypot(here[0] - there[0], here[1] - there[1]) <= kUpToGraze && far <= kUpToGraze &&
         graze.multipliers.cwiseAbs().maxCoeff() <= 1.0 + kHardlyUnstable;
}

bool GrazeBorders::is_on_graze(const BorderEdge& edge) const {
  const PixelPlace middle = middle_of(pixels_, edge);
  for (std::size_t i = 0; i < known_->lines().size(); ++i) {
    const BorderCurve& curve = known_->curves()[i];
    const bool is_its_own = std::ranges::any_of(edge.pixels, [&](std::size_t pixel) {
      return pixels_.label(pixel) == static_cast<int>(curve.period);
    });
    if (curve.kind != BorderKind::grazing || !is_its_own) continue;
    if (known_->lines()[i].distance_to(middle, true) <= kHalfPixel) return true;
  }
  return false;
}

void GrazeBorders::from_lost(std::vector<ExplainedBorder>* borders) {
  const auto mark = [&] {
    for (ExplainedBorder& border : *borders) {
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        EdgeReason* const reason = &border.reasons[i];
        if (*reason == EdgeReason::lost && is_on_graze(border.border.edges[i])) {
          *reason = EdgeReason::graze;
        }
      }
    }
  };
  mark();
  struct Pair {
    BorderEdge edge;
    std::size_t longest;  // period that is looked at
  };
  std::vector<Pair> pairs;
  std::vector<std::size_t> pixels;
  for (const ExplainedBorder& border : *borders) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < border.reasons.size(); ++i) {
      if (border.reasons[i] == EdgeReason::lost) open.push_back(i);
    }
    if (open.size() < kMinLost) continue;
    for (const std::size_t i : evenly(open.size(), kMaxLost)) {
      const BorderEdge& edge = border.border.edges[open[i]];
      pairs.push_back({edge, open.size() < kMinLongLost ? kLongest : kLongestLost});
      pixels.insert(pixels.end(), edge.pixels.begin(), edge.pixels.end());
    }
  }
  settled_->settle(pixels);  // those that a search had settled before it was interrupted
  struct Lost {
    HeldOrbit orbit;
    std::size_t to;
    BorderEdge edge;
  };
  std::vector<Lost> all;
  for (const auto& [edge, longest] : pairs) {
    for (const std::size_t side : {0U, 1U}) {
      const HeldOrbit* const orbit = settled_->orbit(edge.pixels[side]);
      if (orbit == nullptr || orbit->period > longest) continue;
      all.push_back({*orbit, edge.pixels[1 - side], edge});
    }
  }
  std::vector<PairSeed> seeds(all.size());
  JoinedOrbitMap joined(device_);
  for_each_on_threads(all.size(), &joined, [&](std::size_t i) {
    const Lost& lost = all[i];
    seeds[i] = {last_stable(plane_, &joined, lost.orbit, pixels_.place(lost.to)), lost.to,
                lost.edge, kNearLost};
  });
  follow(SearchStage::lost, seeds);
  mark();
}

ContactPairs GrazeBorders::from_contacts(std::size_t min_edges) {
  const std::vector<MapBorder> borders = find_contact_borders(pixels_, min_edges);
  std::vector<std::size_t> needed;
  std::vector<BorderEdge> edges;
  for (const MapBorder& border : borders) {
    for (const std::size_t i : evenly(border.edges.size(), kMaxSeeds)) {
      edges.push_back(border.edges[i]);
      needed.insert(needed.end(), border.edges[i].pixels.begin(), border.edges[i].pixels.end());
    }
  }
  settled_->settle(needed);
  std::vector<PairSeed> seeds;
  for (const BorderEdge& edge : edges) {
    for (const std::size_t side : {0U, 1U}) {
      const HeldOrbit* const orbit = settled_->orbit(edge.pixels[side]);
      if (orbit != nullptr && orbit->period <= kLongest)
        seeds.push_back({*orbit, edge.pixels[1 - side], edge, kNearContact});
    }
  }
  follow(SearchStage::contacts, seeds);
  ContactPairs out;
  for (const MapBorder& border : borders) {
    out.pairs += border.edges.size();
    for (const BorderEdge& edge : border.edges) out.on_curve += is_on_graze(edge) ? 1U : 0U;
  }
  return out;
}

}  // namespace gearsweep
