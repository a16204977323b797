// The parameters of a model's file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "equations/definition.hpp"
#include "study/detail/model_names.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {

// [parameters]. Throws InputError.
void read_parameters(const toml::table* table, ModelNames* names, ModelDefinition* definition);

// A constant that is a number, as a parameter of any value. Throws InputError.
void add_constant_parameter(const toml::node& number, const std::string& name, ModelNames* names,
                            ModelDefinition* definition);

// The key `role`, one of the known ones; none where it is missing. Throws InputError.
Role read_role(TableReader* reader, const std::vector<Role>& known);

}  // namespace gearsweep
