// Which states share a range.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// Model::range_groups of states whose groups have these names; one with an empty name stands for
// itself.
std::vector<std::size_t> range_groups_of(const std::vector<std::string>& names);

}  // namespace gearsweep
