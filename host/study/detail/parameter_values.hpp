// The values that a study gives to parameters: numbers, or expressions of others. All throw
// InputError with the place.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "study/study.hpp"

namespace gearsweep {

// A number, an expression in quotes, or a list of both, which fills NAME, NAME_2, NAME_3, ...
// What was given before is forgotten. origin: where it comes from.
void give_parameter(const toml::node& node, const std::string& name, const std::string& origin,
                    Study* study);

// [parameters]; null where there is none.
void read_parameters(const toml::table* table, Study* study);

// Once parameters and axes are read: what an axis gives has no expression. The model gets the
// expressions that are left, and the study's setting what they come to.
void bind_expressions(Study* study);

// What is uncertain has a number in place of its expression: what that comes to, which must be the
// same at all points. place: of the tolerance.
void take_nominal_of_expression(const toml::node& place, std::size_t parameter, Study* study);

}  // namespace gearsweep
