// Places as Python gives them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "point/place.hpp"

namespace gearsweep::python {

using NamedValues = std::vector<std::pair<std::string, double>>;

inline std::vector<NamedValue> named(const NamedValues& values) {
  std::vector<NamedValue> out;
  for (const auto& [name, value] : values) out.push_back({name, value});
  return out;
}

}  // namespace gearsweep::python
