// The study of a command.
#pragma once

#include <string>
#include <vector>

#include "result/study_source.hpp"

namespace gearsweep {

// What find_study() finds. Tells of what the study has twice.
Study load_study(const std::string& name_or_path, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& zooms = {});

// Tells of that, of a study that is there.
void tell_notices(const Study& study);

}  // namespace gearsweep
