// Derived parameters as coordinates of a result: what they come to at its points.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// The attribute of such a coordinate: the expression that gives it.
inline constexpr const char* kFollows = "follows";

struct DerivedCoordinate {
  Swept parameter;                // its name, unit and meaning; no values
  std::string expression;         // "0.5*wn"
  std::vector<std::size_t> axes;  // of the study, that it changes along: one or two
};

// The derived parameters that axes change. Uncertain parameters have their nominal values.
std::vector<DerivedCoordinate> derived_coordinates(const Study& study);

// How many values it has: along its one axis, or over the map.
std::size_t size_of(const DerivedCoordinate& coordinate, const Study& study);
std::vector<double> values_of(const DerivedCoordinate& coordinate, const Study& study);

}  // namespace gearsweep
