#include "engine/window.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

// Whether a short record of a settled cycle gives all that the study asks for as well as a long
// one. Exponents, statistics and samples are the better the longer it is.
bool does_for_a_cycle(const Study& study) {
  const Selection& selection = study.selection;
  return selection.motion && selection.poincare.empty() &&
         std::ranges::all_of(selection.observers, [](const Observer& observer) {
           return observer.observable->role == ObservableRole::measure ||
                  observer.observable->part == ObservedPart::section;
         });
}

// A model that nothing drives has these; other motions end on their orbits
// (tile/detail/orbit_search.hpp).
std::vector<Window> early_windows(const Study& study) {
  constexpr std::size_t kFewest = 32;  // periods of a record that tell a cycle of some returns
  const Integrate& integrate = study.integrate;
  const std::size_t record = integrate.record / 4;
  const std::vector<Window> windows = {
      {0, integrate.settle / 8, record, 0, false, true},
      {integrate.settle / 8 + record, integrate.settle / 4, record, 0, false, true}};
  const std::size_t end = windows[1].before + windows[1].settle + record;
  const bool fits = record >= kFewest && end + integrate.warm_up <= integrate.settle;
  const bool stops = study.model->is_clockless && integrate.stop == Stop::orbit;
  return fits && stops && does_for_a_cycle(study) ? windows : std::vector<Window>();
}

}  // namespace

Window own_window(const Study& study) {
  const std::vector<Window> windows = windows_of(study);
  return *std::ranges::find(windows, false, &Window::is_early);
}

std::vector<Window> windows_of(const Study& study) {
  const Integrate& integrate = study.integrate;
  const std::size_t samples = study.selection.poincare.empty() ? 0 : integrate.record;
  std::vector<Window> windows = early_windows(study);
  const std::size_t gone =
      windows.empty() ? 0 : windows.back().before + windows.back().settle + windows.back().record;
  windows.push_back({gone, integrate.settle - gone, integrate.record, samples, false});
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
