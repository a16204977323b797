#include "study/detail/probe_starts.hpp"

#include <algorithm>
#include <utility>

namespace gearsweep {

std::vector<ProbeStart> probe_starts(const Study& study) {
  const std::size_t places = study.axes.size() == 1 ? 5 : 3;
  std::vector<std::vector<std::size_t>> chosen(2, std::vector<std::size_t>{0});
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
    const std::size_t count = study.axes[axis].values.size();
    chosen[axis].clear();
    for (std::size_t i = 0; i < places; ++i) chosen[axis].push_back(i * (count - 1) / (places - 1));
    chosen[axis].erase(std::unique(chosen[axis].begin(), chosen[axis].end()), chosen[axis].end());
  }
  std::vector<ProbeStart> starts;
  for (const std::size_t second : chosen[1]) {
    for (const std::size_t first : chosen[0]) {
      const std::size_t index[] = {first, second};
      ProbeStart start = {study.setting, {}};
      std::vector<std::pair<std::size_t, double>> states;
      for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
        for (const Swept& swept : study.axes[axis].swept()) {
          const double value = swept.values[index[axis]];
          if (swept.is_state) {
            states.emplace_back(swept.index, value);
          } else {
            start.setting.parameters[swept.index] = value;
          }
        }
      }
      if (!study.model->check(start.setting).empty()) continue;
      start.state = study.initial.policy == InitialPolicy::fixed
                        ? study.initial.state
                        : study.model->equilibrium(start.setting);
      for (const auto& [state, value] : states) start.state[state] = value;
      starts.push_back(std::move(start));
    }
  }
  return starts;
}

}  // namespace gearsweep
