#include "distribute/extension.hpp"

#include <algorithm>
#include <limits>

#include "sweep_types.h"

namespace gearsweep {

std::vector<std::size_t> undecided_positions(const Study& study, const TileResult& result) {
  const std::size_t points = result.status.size();
  const auto first_class =
      result.outputs.begin() + static_cast<std::ptrdiff_t>(*study.selection.motion * points);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < points; ++i) {
    const bool undecided = first_class[static_cast<std::ptrdiff_t>(i)] == double{MOTION_undecided};
    if (result.status[i] == STATUS_ok && undecided) positions.push_back(i);
  }
  return positions;
}

Tile part_of(const Plan& plan, const Tile& tile, const std::vector<std::size_t>& positions,
             const Window& window) {
  const auto periods = static_cast<double>(window.settle + window.record);
  const auto grid_of = [&](std::size_t position) {
    return std::upper_bound(tile.grid_starts.begin(), tile.grid_starts.end(), position) -
           tile.grid_starts.begin();
  };
  Tile part;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i == 0 || grid_of(positions[i]) != grid_of(positions[i - 1])) {
      part.grid_starts.push_back(i);
    }
    part.points.push_back(tile.points[positions[i]]);
    part.work += static_cast<double>(plan.steps_of(part.points.back())) * periods;
  }
  return part;
}

std::vector<double> end_states(const TileResult& result,
                               const std::vector<std::size_t>& positions) {
  const std::size_t states = result.final_states.size() / result.status.size();
  std::vector<double> ends;
  ends.reserve(positions.size() * states);
  for (const std::size_t position : positions) {
    const auto first = result.final_states.begin() + static_cast<std::ptrdiff_t>(position * states);
    ends.insert(ends.end(), first, first + static_cast<std::ptrdiff_t>(states));
  }
  return ends;
}

void adopt_verdicts(const Study& study, const std::vector<std::size_t>& positions,
                    const TileResult& part, TileResult* whole) {
  const std::size_t points = whole->status.size();
  std::size_t first = 0;
  for (const Observer& observer : study.selection.observers) {
    const ObservableKind kind = observer.observable->kind;
    const bool is_verdict = kind == ObservableKind::tangent || kind == ObservableKind::orbit;
    for (std::size_t output = first; is_verdict && output < first + observer.outputs; ++output) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        whole->outputs[output * points + positions[i]] =
            part.outputs[output * positions.size() + i];
      }
    }
    first += observer.outputs;
  }
  const std::size_t outputs = whole->outputs.size() / points;
  const std::size_t samples = whole->samples.size() / points;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (part.status[i] == STATUS_ok) continue;
    const std::size_t point = positions[i];
    whole->status[point] = part.status[i];
    for (std::size_t output = 0; output < outputs; ++output) {
      whole->outputs[output * points + point] = nan;
    }
    std::fill_n(whole->samples.begin() + static_cast<std::ptrdiff_t>(point * samples), samples,
                nan);
  }
}

}  // namespace gearsweep
