// What studies and traces that are laid over one another are called.
#pragma once

#include <string>
#include <vector>

#include "plot/style.hpp"

namespace gearsweep {

// The names that --legend gives, as markup. Throws InputError unless there are so many.
std::vector<std::string> given_legend(const PlotStyle& style, std::size_t layers);

// The value of a key of a table, without quotes; empty where there is none. toml: a study or its
// settings, as results have them.
std::string setting_in(const std::string& toml, const std::string& table, const std::string& key);

// The parameters and options in which studies differ, "mu=0, backlash=dynamic"; empty where that is
// nothing, or too much to read. toml: the settings of each; axis: a parameter that does not count.
std::vector<std::string> differing_settings(const std::vector<std::string>& toml,
                                            const std::string& axis);

}  // namespace gearsweep
