#include "distribute/assembly.hpp"

#include <algorithm>

#include "sweep_types.h"

namespace gearsweep {

Assembly::Assembly(const Study& study) {
  const std::size_t points = study.points();
  const Selection& selection = study.selection;
  result_.study = study;
  result_.status.resize(points);
  for (const Quantity& quantity : selection.quantities) {
    result_.values.emplace_back(points * quantity.width);
  }
  result_.samples.resize(points * selection.poincare.size() * study.integrate.record);
  final_states_.resize(points * study.model->states.size());
}

void Assembly::add(const Tile& tile, const TileResult& result) {
  const std::size_t count = tile.points.size();
  const std::size_t series = result.samples.size() / count;
  const std::size_t states = result.final_states.size() / count;
  result_.steps += result.effort[0];
  result_.seconds += result.effort[1];
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t point = tile.points[i];
    result_.status[point] = result.status[i];
    for (std::size_t j = 0; j < result_.values.size(); ++j) {
      const Quantity& quantity = result_.study.selection.quantities[j];
      for (std::size_t k = 0; k < quantity.width; ++k) {
        result_.values[j][point * quantity.width + k] =
            result.outputs[(quantity.output + k) * count + i];
      }
    }
    const auto copy = [&](const std::vector<double>& from, std::size_t width,
                          std::vector<double>* to) {
      const auto first = from.begin() + static_cast<std::ptrdiff_t>(i * width);
      std::copy(first, first + static_cast<std::ptrdiff_t>(width),
                to->begin() + static_cast<std::ptrdiff_t>(point * width));
    };
    copy(result.samples, series, &result_.samples);
    copy(result.final_states, states, &final_states_);
  }
}

std::vector<double> Assembly::initial_states(const Plan& plan, const Tile& tile) const {
  const std::size_t states = plan.study().model->states.size();
  std::vector<double> initial;
  initial.reserve(tile.points.size() * states);
  for (const std::size_t point : tile.points) {
    const std::optional<std::size_t> before = plan.predecessor(point);
    if (before && result_.status[*before] == STATUS_ok) {
      const auto first = final_states_.begin() + static_cast<std::ptrdiff_t>(*before * states);
      initial.insert(initial.end(), first, first + static_cast<std::ptrdiff_t>(states));
    } else {
      const std::vector<double> own = plan.own_initial_state(point);
      initial.insert(initial.end(), own.begin(), own.end());
    }
  }
  return initial;
}

SweepResult Assembly::take() { return std::move(result_); }

}  // namespace gearsweep
