// What a model's file says beside its equations: curves that a study measures, checks of a setting,
// states that mirror each other.
#pragma once

#include <toml++/toml.h>

#include "equations/definition.hpp"
#include "study/detail/model_names.hpp"

namespace gearsweep {

// [drawings]: first = "of the input stage". Read after the parameters and curves, of which each
// must have one. Throws InputError.
void read_drawing_names(const toml::table* table, ModelDefinition* definition);

// [model] units = "first": the drawing in whose b_n, k0 and varpi the model is; of one drawing
// alone that is it. Read after the names of drawings. Throws InputError, too, where a parameter of
// another drawing has such a unit.
void read_unit_drawing(const toml::table& model, ModelDefinition* definition);

// Whether a unit is made of those that a drawing gives, as "b_n varpi" is.
bool is_drawing_unit(const std::string& unit);

// [curves]: stiffness = "of the mesh over its period, in k0". Throws InputError.
void read_curves(const toml::table* table, ModelNames* names, ModelDefinition* definition);

// [checks]: "cycle must be a whole number" = "cycle == floor(cycle)". Throws InputError.
void read_checks(const toml::table* table, ModelDefinition* definition);

// A list of { states = "x2 x4 v2 v4", parameters = "m1 m2" }, names pair after pair (MirrorPairs).
// Null where there is none. Throws InputError.
void read_mirrors(const toml::node* node, ModelDefinition* definition);

}  // namespace gearsweep
