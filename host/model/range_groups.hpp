// Which states share a range.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// Model::range_groups of states whose groups have these names; one with an empty name stands for
// itself.
std::vector<std::size_t> range_groups_of(const std::vector<std::string>& names);

// Of a model's header: each of `groups` lists states, the others stand for themselves.
std::vector<std::size_t> range_groups_of(const Model& model,
                                         const std::vector<std::string>& groups);

}  // namespace gearsweep
