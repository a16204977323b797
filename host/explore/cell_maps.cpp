#include "explore/cell_maps.hpp"

#include "sweep/sweep.hpp"

namespace gearsweep {

std::optional<CellMaps> compute_cells(const Scene& scene,
                                      const std::array<std::vector<double>, 2>& values,
                                      const SweepOptions& options) {
  const std::optional<SweepResult> result = run_sweep(scene.at(values), options);
  if (!result) return std::nullopt;
  CellMaps maps = {
      {result->status.begin(), result->status.end()}, result->engine, result->integrated};
  for (const std::vector<double>& map : result->values) {
    maps.numbers.insert(maps.numbers.end(), map.begin(), map.end());
  }
  return maps;
}

}  // namespace gearsweep
