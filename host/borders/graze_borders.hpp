// Finds the grazing curves of a map: from where other curves hardly go on, from orbits that are
// lost between two pixels, and from neighbours of one period whose motions touch other limits.
#pragma once

#include <functional>
#include <vector>

#include "borders/crossing.hpp"
#include "borders/edge_reasons.hpp"
#include "borders/host_orbit_map.hpp"
#include "borders/known_curves.hpp"
#include "borders/search_record.hpp"
#include "borders/settled_pixels.hpp"

namespace gearsweep {

class GrazeBorders {
 public:
  // host: which answers the grazes; device: which holds orbits. All must outlive it.
  GrazeBorders(const ParameterPlane& plane, const PeriodPixels& pixels, HostOrbitMap* host,
               OrbitMap* device, SettledPixels* settled, KnownCurves* known, SearchRecord* record)
      : plane_(plane),
        pixels_(pixels),
        host_(host),
        device_(device),
        settled_(settled),
        known_(known),
        record_(record) {}

  // From where curves stopped, or turned in a corner.
  void from_stops();
  // From orbits that are lost; pairs that a grazing curve passes between have that as their reason.
  void from_lost(std::vector<ExplainedBorder>* borders);
  // From pairs of pixels that differ in the contact.
  ContactPairs from_contacts(std::size_t min_edges);

 private:
  // An orbit, and the pair of pixels that the graze is looked for between.
  struct PairSeed {
    HeldOrbit orbit;
    std::size_t to = 0;
    BorderEdge edge;
    double near = 0.0;
  };

  // A place where grazes are looked for, unless a grazing curve of that period passes within so
  // many pixels.
  struct Search {
    std::size_t period = 1;
    PlanePlace place{};
    double already = 0.0;
    std::function<std::vector<Crossing>()> find;
  };

  void run(SearchStage stage, const std::vector<Search>& searches);
  std::vector<BorderCurve> curves_of(const Search& search) const;
  void follow(SearchStage stage, const std::vector<PairSeed>& seeds);
  std::vector<Crossing> beside_stop(const BorderCurve& curve, const BorderPoint& point) const;
  std::vector<Crossing> between(const PairSeed& seed) const;
  // Whether a motion that settles hardly differs from a graze.
  bool comes_up_to(const HeldOrbit& orbit, const BorderPoint& graze) const;
  bool is_on_graze(const BorderEdge& edge) const;

  const ParameterPlane& plane_;
  const PeriodPixels& pixels_;
  HostOrbitMap* const host_;
  OrbitMap* const device_;
  SettledPixels* const settled_;
  KnownCurves* const known_;
  SearchRecord* const record_;
};

}  // namespace gearsweep
