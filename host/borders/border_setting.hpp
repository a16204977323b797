// What a search for borders computes with: the plane of a map's parameters, and its study twice.
#pragma once

#include <algorithm>
#include <memory>

#include "borders/parameter_plane.hpp"
#include "study/study.hpp"

namespace gearsweep {

struct BorderSetting {
  ParameterPlane plane;                    // of the reduced model, if there is one
  std::shared_ptr<const Study> settling;   // with the steps of the map
  std::shared_ptr<const Study> following;  // with those of the curves
};

// study: of the map, with the step that it was computed with. steps: minimum of a forcing period;
// 0: kBorderSteps, or the study's. Throws InputError for a map that has no plane of two parameters,
// and for a model that is not driven, has two frequencies, or jumps where tangents do not.
BorderSetting make_border_setting(const Study& study, std::size_t steps);

inline constexpr std::size_t kBorderSteps = 256;
// The host, which cuts steps at contacts and is slow, takes fewer.
inline std::size_t host_steps(const Study& following) {
  return std::max<std::size_t>(following.integrate.steps_per_period / 2, 64);
}

}  // namespace gearsweep
