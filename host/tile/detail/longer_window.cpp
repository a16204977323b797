#include "tile/detail/longer_window.hpp"

#include <set>

#include "sweep_types.h"

namespace gearsweep {

std::vector<std::size_t> undecided_positions(const Study& study, const TileResult& result) {
  const std::span<const double> motion = result.output_table()[*study.selection.motion];
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const bool is_undecided = motion[i] == double{MOTION_undecided};
    if (result.status[i] == STATUS_ok && is_undecided) positions.push_back(i);
  }
  return positions;
}

namespace {

void adopt(const Study& study, const std::set<ObservableRole>& roles,
           const std::vector<std::size_t>& positions, const TileResult& subset, TileResult* whole) {
  std::size_t first = 0;
  for (const Observer& observer : study.selection.observers) {
    const bool is_adopted = roles.contains(observer.observable->role);
    for (std::size_t output = first; is_adopted && output < first + observer.outputs; ++output) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        whole->output_table()[output][positions[i]] = subset.output_table()[output][i];
      }
    }
    first += observer.outputs;
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (subset.status[i] == STATUS_ok) continue;
    whole->status[positions[i]] = subset.status[i];
    blank_point(positions[i], whole);
  }
}

}  // namespace

void adopt_verdicts(const Study& study, const std::vector<std::size_t>& positions,
                    const TileResult& subset, TileResult* whole) {
  adopt(study, {ObservableRole::verdict}, positions, subset, whole);
}

void adopt_longer_window(const Study& study, const std::vector<std::size_t>& positions,
                         const TileResult& subset, TileResult* whole) {
  std::set<ObservableRole> roles = {ObservableRole::verdict, ObservableRole::statistic};
  if (study.model->is_clockless) roles.insert(ObservableRole::measure);
  adopt(study, roles, positions, subset, whole);
}

}  // namespace gearsweep
