// Rules that hold for every built-in model: asked of a few with each change, and of all others
// every week (`WEEKLY Others/*` in tests/CMakeLists.txt).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "study/builtin_models.hpp"

namespace gearsweep::testing {

// Between them they have options, scales and an angle, are forced and free, and bend, jump and
// reset.
inline std::vector<std::string> few_models() {
  return {"coulomb", "duffing", "gear5", "hard_impact", "lorenz", "pendulum"};
}

inline std::vector<std::string> other_models() {
  const std::vector<std::string> few = few_models();
  std::vector<std::string> names = model_names();
  std::erase_if(names, [&](const std::string& name) { return std::ranges::count(few, name) > 0; });
  return names;
}

// A test with the name of a model as its parameter.
class OfEachModel : public ::testing::TestWithParam<std::string> {
 protected:
  static const Model& its_model() { return *find_model(GetParam()); }
};

inline std::string name_of_model(const ::testing::TestParamInfo<std::string>& info) {
  return info.param;
}

}  // namespace gearsweep::testing
