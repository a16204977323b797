#include "study/found_step.hpp"

#include <fmt/format.h>

namespace gearsweep {

FoundStep FoundStep::of(const Study& study) {
  return {study.integrate.max_step, study.integrate.orbit_steps};
}

std::string FoundStep::words_of_orbits() const {
  return orbit_steps > 1 ? fmt::format(", 1/{} of that on orbits", orbit_steps) : "";
}

void FoundStep::give_to(Study* study) const {
  study->integrate.max_step = max_step;
  study->integrate.orbit_steps = study->selection.census ? 1 : orbit_steps;
}

std::vector<std::string> FoundStep::overrides() const {
  return {"integrate.tolerance=0", fmt::format("integrate.max_step={}", max_step),
          fmt::format("integrate.orbit_steps={}", orbit_steps)};
}

}  // namespace gearsweep
