// The plane of two parameters of a model, in which borders between kinds of motion are curves.
#pragma once

#include <array>
#include <cstddef>

#include "model/model.hpp"

namespace gearsweep {

using PlanePlace = std::array<double, 2>;  // the values of its parameters

struct ParameterPlane {
  const Model* model = nullptr;
  ModelSetting setting;  // all other parameters
  std::array<std::size_t, 2> parameters{};
  PlanePlace from{}, to{};  // its window; from < to

  ModelSetting setting_at(const PlanePlace& place) const;
  double range(std::size_t axis) const { return to[axis] - from[axis]; }
  bool contains(const PlanePlace& place) const;
  // Whether the model takes these values.
  bool is_allowed(const PlanePlace& place) const;
};

}  // namespace gearsweep
