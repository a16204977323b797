#include "tile/detail/longer_window.hpp"

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

void adopt_verdicts(const Study& study, const std::vector<std::size_t>& positions,
                    const TileResult& part, TileResult* whole) {
  const std::size_t points = whole->status.size();
  std::size_t first = 0;
  for (const Observer& observer : study.selection.observers) {
    const bool is_verdict = observer.observable->role == ObservableRole::verdict;
    for (std::size_t output = first; is_verdict && output < first + observer.outputs; ++output) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        whole->outputs[output * points + positions[i]] =
            part.outputs[output * positions.size() + i];
      }
    }
    first += observer.outputs;
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (part.status[i] == STATUS_ok) continue;
    whole->status[positions[i]] = part.status[i];
    blank_point(positions[i], whole);
  }
}

}  // namespace gearsweep
