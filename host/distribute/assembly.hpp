// Puts the answers of tiles together to the maps of a sweep. Private to this folder.
#pragma once

#include "engine/engine.hpp"

namespace gearsweep {

class Assembly {
 public:
  explicit Assembly(const Study& study);

  void add(const Tile& tile, const TileResult& result);

  // [point of the tile][state]: where each point of a tile starts. A point whose predecessor has
  // diverged starts from its own initial state.
  std::vector<double> initial_states(const Plan& plan, const Tile& tile) const;

  SweepResult take();

 private:
  SweepResult result_;
  std::vector<double> final_states_;  // [point][state]
};

}  // namespace gearsweep
