// Axes in the units of a drawing: a key of the [gear] table is swept.
#pragma once

#include <toml++/toml.h>

#include "study/detail/gear_reader.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The key of [gear] of this name that an axis of the model can sweep; nullptr if there is none.
const GearKey* find_swept_key(const Model& model, const std::string& name);

// Fills in what the axis has from its key, but for the values and the columns.
void bind_key(const GearKey& key, Axis* axis);

// Gives the axis, whose values are there, the parameters that follow from each of them as columns.
// others: values of other keys, in place of those of the table. place: what messages point to.
// Throws InputError for what [gear] refuses, and where the units of the result would change from
// value to value.
void add_parameters(const GearKey& key, const toml::table& gear, const GearValues& others,
                    const Model& model, const toml::node& place, Axis* axis);

// The values of [gear] that the axes of a study of the model give: the first of each.
GearValues first_values(const Model& model, const std::vector<Axis>& axes);

}  // namespace gearsweep
