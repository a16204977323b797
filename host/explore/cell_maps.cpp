#include "explore/cell_maps.hpp"

#include "sweep/sweep.hpp"

namespace gearsweep {

std::optional<std::vector<double>> compute_cells(const Scene& scene,
                                                 const std::array<std::vector<double>, 2>& values,
                                                 const SweepOptions& options) {
  const std::optional<SweepResult> result = run_sweep(scene.at(values), options);
  if (!result) return std::nullopt;
  std::vector<double> numbers(result->status.begin(), result->status.end());
  for (const std::vector<double>& map : result->values) {
    numbers.insert(numbers.end(), map.begin(), map.end());
  }
  return numbers;
}

}  // namespace gearsweep
