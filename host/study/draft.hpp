// A study that is still being built.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// As read_study(), of a text that may still lack its axes: a study needs them only to be run. The
// axes of a draft that has none are empty.
Study read_draft(const std::string& text, const std::string& source,
                 const std::vector<std::string>& overrides = {}, const PointTable& points = {});

}  // namespace gearsweep
