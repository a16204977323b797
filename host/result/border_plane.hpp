// The plane that the curves of a file lie in: two parameters of a model, all others as its study
// has them.
#pragma once

#include <optional>
#include <string>

#include "result/border_file.hpp"
#include "study/study.hpp"

namespace gearsweep {

// What one plane has and another has not: "over omega and b", "of mu = 0.2".
struct PlaneDifference {
  std::string of_curves, of_map;
};

// The first difference between the plane of curves and that of a map, each by its study; nothing
// where both are the same plane, whichever of its parameters is x. Starts, steps and quantities do
// not matter: curves are of all motions, wherever they start.
std::optional<PlaneDifference> plane_difference(const Study& curves, const Study& map);

// The study of the map that the curves of a file are of. Throws InputError where the file has none,
// or one of other parameters.
Study read_border_study(const std::string& path, const StoredCurves& stored);

// Throws InputError, which calls the curves `name`, where they are not over the axes of this study.
void require_own_study(const std::string& name, const Study& study, const StoredCurves& stored);

// Throws InputError where curves of this study do not lie in the plane of a map. origin: where the
// curves were given, "--curves curves.nc".
void require_plane(const std::string& origin, const Study& curves, const Study& map);

}  // namespace gearsweep
