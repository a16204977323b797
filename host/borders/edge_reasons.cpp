#include "borders/edge_reasons.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

constexpr int kPartsOfWay = 4;      // in which an orbit is carried from pixel to pixel
constexpr double kNextReach = 0.5;  // sizes of the states, in one of them

// An orbit on its way from a pixel over its neighbour.
struct Carried {
  EdgeReason* reason;
  const MapBorder* border;
  const BorderEdge* edge;
  HeldOrbit at;
  PlanePlace step;
  Eigen::VectorXd change;  // of the state, by the last step
};

}  // namespace

std::string describe(EdgeReason reason) {
  switch (reason) {
    case EdgeReason::curve:
      return "a curve passes between them";
    case EdgeReason::basin:
      return "a motion goes on beyond the border (a change of basin)";
    case EdgeReason::lost:
      return "an orbit is lost, and no curve was found";
    case EdgeReason::graze:
      return "an orbit is lost where it begins to touch or to part";
    case EdgeReason::unsettled:
      break;
  }
  return "neither motion was found again";
}

std::size_t ExplainedBorder::count(EdgeReason reason) const {
  return static_cast<std::size_t>(std::ranges::count(reasons, reason));
}

namespace {

// Carries each orbit on by a part of its way. is_beyond: all have come to their other pixels.
void carry_on(const ParameterPlane& plane, OrbitMap* map, const CurveBeyond& has_curve_beyond,
              bool is_beyond, std::vector<Carried>* under_way) {
  std::vector<HeldOrbit> guesses;
  for (const Carried& carried : *under_way) {
    guesses.push_back(carried.at);
    guesses.back().state += carried.change;
    for (std::size_t k = 0; k < 2; ++k) guesses.back().place[k] += carried.step[k];
  }
  const auto found = hold_orbits(plane, map, guesses, kNextReach);
  std::vector<Carried> left;
  std::vector<HeldOrbit> orbits;
  // It has come to the other pixel, and ends behind it where a curve tells why.
  const auto end = [&](const Carried& carried) {
    if (is_beyond && has_curve_beyond(*carried.border, *carried.edge)) {
      *carried.reason = EdgeReason::basin;
    }
  };
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] || !found[i]->is_stable()) {
      end((*under_way)[i]);
      continue;
    }
    Carried carried = (*under_way)[i];
    carried.change = found[i]->state - carried.at.state;
    carried.at = *found[i];
    orbits.push_back(carried.at);
    left.push_back(std::move(carried));
  }
  // Beyond a flip Newton's method comes to the orbit of half the period, twice around.
  const std::vector<bool> is_shorter = return_sooner(plane, map, orbits);
  under_way->clear();
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (is_shorter[i]) {
      end(left[i]);
    } else {
      under_way->push_back(std::move(left[i]));
    }
  }
}

}  // namespace

void explain_without_curves(const ParameterPlane& plane, const PeriodPixels& pixels, OrbitMap* map,
                            SettledPixels* settled, const CurveBeyond& has_curve_beyond,
                            std::vector<ExplainedBorder>* borders) {
  const auto each_open = [&](const auto& take) {
    for (ExplainedBorder& border : *borders) {
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        const BorderEdge& edge = border.border.edges[i];
        const auto [a, b] = edge.pixels;
        take(a, b, Carried{&border.reasons[i], &border.border, &edge, {}, {}, {}});
        take(b, a, Carried{&border.reasons[i], &border.border, &edge, {}, {}, {}});
      }
    }
  };
  std::vector<std::size_t> ends;
  each_open([&](std::size_t from, std::size_t, const Carried&) { ends.push_back(from); });
  settled->settle(ends);
  std::vector<Carried> under_way;
  each_open([&](std::size_t from, std::size_t to, Carried carried) {
    const HeldOrbit* orbit = settled->orbit(from);
    if (orbit == nullptr) return;
    *carried.reason = EdgeReason::lost;
    const PlanePlace here = pixels.place(from), there = pixels.place(to);
    for (std::size_t k = 0; k < 2; ++k) carried.step[k] = (there[k] - here[k]) / kPartsOfWay;
    carried.at = *orbit;
    carried.change = Eigen::VectorXd::Zero(orbit->state.size());
    under_way.push_back(std::move(carried));
  });
  for (int part = 0; part < 2 * kPartsOfWay && !under_way.empty(); ++part) {
    carry_on(plane, map, has_curve_beyond, part >= kPartsOfWay, &under_way);
  }
  for (const Carried& carried : under_way) *carried.reason = EdgeReason::basin;
}

}  // namespace gearsweep
