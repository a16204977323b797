#include "tile/subset.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {

std::size_t grid_of(const Tile& tile, std::size_t position) {
  const auto after = std::upper_bound(tile.grid_starts.begin(), tile.grid_starts.end(), position);
  return static_cast<std::size_t>(after - tile.grid_starts.begin()) - 1;
}

Tile part_of(const Plan& plan, const Tile& tile, const std::vector<std::size_t>& positions,
             std::size_t periods) {
  Tile part;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i == 0 || grid_of(tile, positions[i]) != grid_of(tile, positions[i - 1])) {
      part.grid_starts.push_back(i);
    }
    part.points.push_back(tile.points[positions[i]]);
    part.work +=
        static_cast<double>(plan.steps_of(part.points.back())) * static_cast<double>(periods);
  }
  return part;
}

std::vector<double> own_initial_states(const Plan& plan, const Tile& tile) {
  std::vector<double> initial;
  initial.reserve(tile.points.size() * plan.study().model->states.size());
  for (const std::size_t point : tile.points) {
    const std::vector<double> own = plan.own_initial_state(point);
    initial.insert(initial.end(), own.begin(), own.end());
  }
  return initial;
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

TileResult empty_result(const Study& study, std::size_t points) {
  const Selection& selection = study.selection;
  TileResult result;
  result.status.resize(points);
  result.outputs.resize(points * selection.output_count());
  result.samples.resize(points * selection.poincare.size() * study.integrate.record);
  result.final_states.resize(points * study.model->states.size());
  return result;
}

void require_fit(const Study& study, const Tile& tile, const TileResult& result) {
  const TileResult right = empty_result(study, tile.points.size());
  const bool has_states = study.is_chained();  // only neighbours in a chain ask for them again
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

void put_part(const Study& study, const TileResult& part, const std::vector<std::size_t>& positions,
              TileResult* whole) {
  const std::size_t count = positions.size();
  const std::size_t points = whole->status.size();
  const std::size_t states = study.model->states.size();
  const std::size_t outputs = study.selection.output_count();
  const std::size_t sampled = study.selection.poincare.size();
  const std::size_t record = study.integrate.record;
  const std::size_t given = sampled > 0 ? part.samples.size() / (count * sampled) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t position = positions[i];
    whole->status[position] = part.status[i];
    for (std::size_t output = 0; output < outputs; ++output) {
      whole->outputs[output * points + position] = part.outputs[output * count + i];
    }
    for (std::size_t state = 0; state < states; ++state) {
      whole->final_states[position * states + state] = part.final_states[i * states + state];
    }
    for (std::size_t chosen = 0; chosen < sampled; ++chosen) {
      for (std::size_t sample = 0; sample < record; ++sample) {
        whole->samples[(position * sampled + chosen) * record + sample] =
            part.samples[(i * sampled + chosen) * given + sample % given];
      }
    }
  }
}

}  // namespace gearsweep
