// Where a study comes from: a TOML file, a result file, or a built-in study by name.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// Names of the built-in studies, in alphabetical order.
std::vector<std::string> builtin_study_names();

// TOML text of a built-in study. Throws InputError for an unknown name.
const std::string& builtin_study_text(const std::string& name);

// The study that made a result file, with its list of points; its text may name no files. Throws
// InputError. No other thread may be at a NetCDF file meanwhile.
Study read_result_study(const std::string& path, const std::vector<std::string>& overrides = {},
                        const std::vector<std::string>& zooms = {});

// Throws InputError when there is neither such a file nor such a built-in study, or it is wrong. No
// other thread may be at a NetCDF file meanwhile.
Study find_study(const std::string& name_or_path, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& zooms = {});

// The same of a study that may still lack its axes (study/draft.hpp), or may be a drawing alone:
// its tables [gear] and [gear.NAME], for the model gear5.
Study find_draft(const std::string& name_or_path, const std::vector<std::string>& overrides);

}  // namespace gearsweep
