#include "study/settings.hpp"

#include <fmt/format.h>

namespace gearsweep {
std::string resolved_settings(const Study& study) {
  const Model& model = *study.model;
  std::string text = fmt::format("[model]\nname = '{}'\n", model.name);
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const auto chosen = static_cast<std::size_t>(study.setting.options[i]);
    text += fmt::format("{} = '{}'\n", model.options[i].name, model.options[i].choices[chosen]);
  }
  text += "[parameters]\n";
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const std::string& name = model.parameters[i].name;
    // No number is that of all points, then.
    const DerivedParameter* const derived = study.differs(i) ? model.find_derived(i) : nullptr;
    text += derived != nullptr ? fmt::format("{} = '{}'\n", name, derived->expression)
                               : fmt::format("{} = {}\n", name, study.setting.parameters[i]);
  }
  const Integrate& integrate = study.integrate;
  text += fmt::format("[integrate]\nprecision = '{}'\n", integrate.fp64 ? "fp64" : "fp32");
  text += integrate.steps_per_period > 0
              ? fmt::format("steps_per_period = {}\n", integrate.steps_per_period)
              : fmt::format("max_step = {}\n", integrate.max_step);
  text += fmt::format("orbit_steps = {}\n", integrate.orbit_steps);
  text += fmt::format("events = {}\n", integrate.events);
  text += fmt::format("settle = {}\nrecord = {}\nwarm_up = {}\nextend = {}\n", integrate.settle,
                      integrate.record, integrate.warm_up, integrate.extend);
  text += fmt::format("stop = \"{}\"\n", integrate.stop == Stop::orbit ? "orbit" : "never");
  text += fmt::format("states = \"{}\"\n", integrate.states == States::driving ? "driving" : "all");
  return text;
}

}  // namespace gearsweep
