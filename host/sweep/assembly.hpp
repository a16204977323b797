// Puts the answers of tiles together to the maps of a sweep.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "attractors/attractor_census.hpp"
#include "engine/engine.hpp"
#include "sweep/draw_maps.hpp"

namespace gearsweep {

class Assembly {
 public:
  Assembly(const Study& study, std::size_t states);

  void add(const Plan& plan, const Tile& tile, const TileResult& result);

  // [point of the tile][state]: where each point of a tile starts. A point whose predecessor has
  // diverged starts from its own initial state.
  std::vector<double> initial_states(const Plan& plan, const Tile& tile) const;

  // The maps, with the devices that computed them.
  SweepResult take();

 private:
  void add_summary(std::size_t trajectory, const TileResult& result, std::size_t position);
  void take_census();

  SweepResult result_;
  std::vector<double> final_states_;  // [point][state]
  std::set<std::string> devices_;
  std::optional<DrawMaps> draws_;             // of a study with uncertain parameters
  std::vector<TrajectorySummary> summaries_;  // [trajectory]; empty unless the study has a census
};

}  // namespace gearsweep
