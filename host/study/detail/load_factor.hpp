// The dynamic load factors of a model: the largest force between teeth over what it carries.
#pragma once

#include <string>
#include <vector>

#include "study/selection.hpp"

namespace gearsweep {

inline constexpr const char* kLoadFactor = "dynamic_load_factor";

struct LoadFactor {
  Quantity quantity;
  std::string force;  // the signal
};

// One for each force with a load. With several forces, each name begins with that of the signal.
std::vector<LoadFactor> load_factors(const Model& model);

// Why a model has no load factor, and what its file must say; empty of one that has.
std::string lack_of_load(const Model& model);

}  // namespace gearsweep
