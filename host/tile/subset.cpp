#include "tile/subset.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {

std::size_t grid_of(const Tile& tile, std::size_t position) {
  const auto after = std::upper_bound(tile.grid_starts.begin(), tile.grid_starts.end(), position);
  return static_cast<std::size_t>(after - tile.grid_starts.begin()) - 1;
}

Tile subset_of(const Plan& plan, const Tile& tile, const std::vector<std::size_t>& positions,
               std::size_t periods) {
  Tile subset;
  double work = 0.0;  // of a point on the present grid
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::size_t point = tile.points[positions[i]];
    if (i == 0 || grid_of(tile, positions[i]) != grid_of(tile, positions[i - 1])) {
      subset.grid_starts.push_back(i);
      work = static_cast<double>(plan.steps_of(point)) * static_cast<double>(periods);
    }
    subset.points.push_back(point);
    subset.work += work;
  }
  return subset;
}

std::vector<double> own_initial_states(const Plan& plan, const Tile& tile) {
  std::vector<double> initial;
  initial.reserve(tile.points.size() * plan.study().model->states.size());
  for (const std::size_t point : tile.points) append(plan.own_initial_state(point), &initial);
  return initial;
}

std::vector<double> end_states(const TileResult& result,
                               const std::vector<std::size_t>& positions) {
  const Array2<const double> states = result.state_table();
  std::vector<double> ends;
  ends.reserve(positions.size() * states.columns());
  for (const std::size_t position : positions) append(states[position], &ends);
  return ends;
}

TileResult empty_result(const Study& study, std::size_t points) {
  const Selection& selection = study.selection;
  TileResult result;
  result.status.resize(points);
  result.outputs.resize(points * selection.output_count());
  result.samples.resize(points * selection.poincare.size() * study.integrate.record);
  result.final_states.resize(points * study.model->states.size());
  return result;
}

bool has_final_states(const Study& study, const Tile& tile) {
  if (study.stages() == 1) return false;
  return study.is_chained() || tile.points.front() < study.points();
}

void require_fit(const Study& study, const Tile& tile, const TileResult& result) {
  const TileResult right = empty_result(study, tile.points.size());
  const bool has_states = has_final_states(study, tile);
  if (result.status.size() == right.status.size() &&
      result.outputs.size() == right.outputs.size() &&
      result.samples.size() == right.samples.size() &&
      result.final_states.size() == (has_states ? right.final_states.size() : 0)) {
    return;
  }
  throw InputError(
      "the journal is damaged: a tile in it is not of the size that the study has; delete it "
      "(--restart does)");
}

void put_subset(const Study& study, const TileResult& subset,
                const std::vector<std::size_t>& positions, TileResult* whole) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::size_t position = positions[i];
    whole->status[position] = subset.status[i];
    for (std::size_t output = 0; output < study.selection.output_count(); ++output) {
      whole->output_table()[output][position] = subset.output_table()[output][i];
    }
    std::ranges::copy(subset.state_table()[i], whole->state_table()[position].begin());
    const std::size_t chosen = study.selection.poincare.size();
    for (std::size_t state = 0; state < chosen; ++state) {
      const std::span<const double> from = subset.sample_table(chosen)[i][state];
      const std::span<double> to = whole->sample_table(chosen)[position][state];
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k % from.size()];
    }
  }
}

}  // namespace gearsweep
