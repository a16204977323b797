#include "model/range_groups.hpp"

#include <algorithm>

namespace gearsweep {

std::vector<std::size_t> range_groups_of(const std::vector<std::string>& names) {
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto first = std::ranges::find(names, names[i]);
    groups.push_back(names[i].empty() ? i : static_cast<std::size_t>(first - names.begin()));
  }
  return groups;
}

}  // namespace gearsweep
