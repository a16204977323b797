#include "model/range_groups.hpp"

#include <algorithm>
#include <stdexcept>

#include "model/names.hpp"

namespace gearsweep {

std::vector<std::size_t> range_groups_of(const std::vector<std::string>& names) {
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto first = std::ranges::find(names, names[i]);
    groups.push_back(names[i].empty() ? i : static_cast<std::size_t>(first - names.begin()));
  }
  return groups;
}

std::vector<std::size_t> range_groups_of(const Model& model,
                                         const std::vector<std::string>& groups) {
  std::vector<std::string> names(model.states.size());
  for (const std::string& group : groups) {
    for (const std::string& state : split_words(group)) {
      const int found = model.find_state(state);
      if (found < 0) throw std::logic_error("no '" + state + "' to share a range");
      names[static_cast<std::size_t>(found)] = group;
    }
  }
  return range_groups_of(names);
}

}  // namespace gearsweep
