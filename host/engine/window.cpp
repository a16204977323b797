#include "engine/window.hpp"

namespace gearsweep {

std::vector<Window> windows_of(const Study& study) {
  const Integrate& integrate = study.integrate;
  const std::size_t samples = study.selection.poincare.empty() ? 0 : integrate.record;
  std::vector<Window> windows = {{.settle = integrate.settle,
                                  .record = integrate.record,
                                  .samples = samples,
                                  .is_last = false}};
  if (study.selection.motion) {
    for (std::size_t factor = 2; factor <= integrate.extend; factor *= 2) {
      const Window& previous = windows.back();
      const std::size_t before = previous.before + previous.settle + previous.record;
      // The tangent vectors start anew and have to turn in again.
      windows.push_back({before, integrate.warm_up, factor * integrate.record, 0, false});
    }
  }
  windows.back().is_last = true;
  return windows;
}

}  // namespace gearsweep
