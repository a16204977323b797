// A study as TOML that is pleasant to read.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace gearsweep {

// Tables and keys in the order in which the manual has them (study_tables()), each table under its
// heading, long lists in lines. The study must have been read: what is not known is not printed.
std::string print_study(const toml::table& study);

}  // namespace gearsweep
