// The [points] of a study: a list of points as an axis.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/detail/study_files.hpp"
#include "study/point_table.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The list of the study, empty without [points]: `given`, unless that is empty, or what [points]
// says. Leaves it in [points] as names and numbers, also where it was a file. Throws InputError.
PointTable take_in_points(const StudyFiles& files, const PointTable& given, toml::table* study);

// The axis 'point' of a list that is not empty, without what follows from keys of [gear]. Throws
// InputError for a name that is neither a parameter or a state of the model nor such a key, and for
// values out of range. place: where messages point to.
Axis axis_of_points(const PointTable& points, const toml::node& place, const toml::table& study,
                    const Model& model);

// The study without the numbers of [points].
toml::table without_numbers(const toml::table& study);

}  // namespace gearsweep
