// The orbits that pixels of a map have settled on, found again.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "borders/held_orbits.hpp"
#include "borders/map_borders.hpp"
#include "engine/engine.hpp"
#include "study/study.hpp"

namespace gearsweep {

class SettledPixels {
 public:
  // study: whose starts and steps the map was computed with. held: what Newton's method uses. All
  // must outlive it.
  SettledPixels(std::shared_ptr<const Study> study, const ParameterPlane& plane,
                const PeriodPixels& pixels, Engine* engine, OrbitMap* held,
                const std::atomic<bool>* stop);

  // Settles those that are not yet known. Throws SearchStopped.
  void settle(const std::vector<std::size_t>& pixels);
  // The stable orbit of a pixel that was settled; null where it has none, or was not found again.
  const HeldOrbit* orbit(std::size_t pixel) const;

 private:
  // Gives guesses the sizes of their states, and drops those whose motion leaves its range. owners:
  // the pixel of each.
  void take_sizes(std::vector<HeldOrbit>* guesses, std::vector<std::size_t>* owners) const;

  const std::shared_ptr<const Study> study_;
  const ParameterPlane& plane_;
  const PeriodPixels& pixels_;
  Engine* const engine_;
  OrbitMap* const held_;
  const std::atomic<bool>* const stop_;
  std::map<std::size_t, std::optional<HeldOrbit>> known_;
};

}  // namespace gearsweep
