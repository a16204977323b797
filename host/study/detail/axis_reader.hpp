// The [[axes]] of a study.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// Up to two axes of distinct parameters or states, in range, the values of [[axes]] increasing; a
// list of points, unless it is empty, is the last one. Throws InputError. `study` is where the axes
// hang, for messages.
std::vector<Axis> read_axes(const toml::table& study, const PointTable& points, const Model& model);

// Once the study's model has its expressions: refuses an axis of a parameter that nothing depends
// on. Throws InputError.
void refuse_idle_axes(const toml::table& study, const Study& read);

// Gives axes over keys of [gear] their columns, and refuses two axes that give one parameter.
// Throws InputError.
void take_in_gear(const toml::table& study, const Model& model, std::vector<Axis>* axes);

}  // namespace gearsweep
