#include "scheduler/make_engine.hpp"

#include <algorithm>

#include "opencl/opencl_engine.hpp"
#include "reference/reference_engine.hpp"

namespace gearsweep {

std::unique_ptr<Engine> make_engine(const Study& study, std::optional<DeviceChoice> choice,
                                    Scheduler* scheduler) {
  if (study.integrate.engine == EngineKind::reference) return make_reference_engine();
  return make_opencl_engine(study, choice, &scheduler->devices());
}

std::vector<std::unique_ptr<Engine>> make_engines(const Study& study,
                                                  const std::vector<DeviceChoice>& devices,
                                                  Scheduler* scheduler, const Warn& warn) {
  std::vector<std::unique_ptr<Engine>> engines;
  std::vector<std::optional<DeviceChoice>> choices(devices.begin(), devices.end());
  if (study.integrate.engine == EngineKind::reference) {
    engines.push_back(make_engine(study, std::nullopt, scheduler));
    return engines;
  }
  if (choices.empty()) choices = {std::nullopt};
  // In a chained study each point waits for the one before it.
  const std::size_t at_once =
      study.trajectories() /
      (study.is_chained() ? study.axes[study.initial.along].values.size() : 1);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    try {
      engines.push_back(make_opencl_engine(study, choices[i], &scheduler->devices()));
      // While one tile's launches end raggedly, or the host looks at their results, those of
      // others fill the device.
      const std::size_t tiles = std::min(engines.back()->tiles_at_once(),
                                         at_once / (choices.size() * engines.back()->min_tile()));
      for (std::size_t more = 1; more < tiles; ++more) {
        engines.push_back(make_opencl_engine(study, choices[i], &scheduler->devices()));
      }
    } catch (const std::runtime_error& error) {
      if (engines.empty() && i + 1 == choices.size()) throw;
      if (warn) warn(error.what());
    }
  }
  return engines;
}

}  // namespace gearsweep
