#include "distribute/make_engine.hpp"

#include "opencl/opencl_engine.hpp"
#include "reference/reference_engine.hpp"

namespace gearsweep {

std::unique_ptr<Engine> make_engine(const Study& study, std::optional<DeviceChoice> choice) {
  if (study.integrate.engine == EngineKind::reference) return make_reference_engine();
  return make_opencl_engine(study, choice);
}

std::vector<std::unique_ptr<Engine>> make_engines(const Study& study,
                                                  const std::vector<DeviceChoice>& devices,
                                                  const Trouble& on_trouble) {
  std::vector<std::optional<DeviceChoice>> choices(devices.begin(), devices.end());
  if (choices.empty() || study.integrate.engine == EngineKind::reference) choices = {std::nullopt};
  std::vector<std::unique_ptr<Engine>> engines;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const bool is_last_hope = engines.empty() && i + 1 == choices.size();
    try {
      engines.push_back(make_engine(study, choices[i]));
    } catch (const std::runtime_error& error) {
      if (is_last_hope) throw;
      if (on_trouble) on_trouble(error.what());
    }
  }
  return engines;
}

}  // namespace gearsweep
