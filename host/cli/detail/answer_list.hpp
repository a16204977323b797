// Models and their known answers, as a table of Markdown: what doc/zoo.md has.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

std::string answer_list(const std::vector<const Model*>& models);

}  // namespace gearsweep
