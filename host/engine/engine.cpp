#include "engine/engine.hpp"

#include <algorithm>
#include <limits>

namespace gearsweep {

void blank_point(std::size_t point, TileResult* result) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t points = result->status.size();
  const std::size_t samples = result->samples.size() / points;
  for (std::size_t i = point; i < result->outputs.size(); i += points) result->outputs[i] = nan;
  std::fill_n(result->samples.begin() + static_cast<std::ptrdiff_t>(point * samples), samples, nan);
}

double answer_bytes(const Study& study) {
  const std::size_t numbers = study.selection.output_count() +
                              study.selection.poincare.size() * study.integrate.record +
                              study.model->states.size();
  return static_cast<double>(1 + numbers * sizeof(double));
}

TileMemory Engine::tile_memory(const Plan& plan, const Tile& tile) const {
  return {0.0, 0.0, 2.0 * static_cast<double>(tile.points.size()) * answer_bytes(plan.study())};
}

}  // namespace gearsweep
