#include <fmt/format.h>

#include <algorithm>

#include "result/result_file.hpp"

namespace gearsweep {

std::size_t ResultMap::points() const {
  std::size_t count = 1;
  for (const ResultAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::size_t ResultMap::part_count() const { return std::max<std::size_t>(1, parts.size()); }

bool ResultMap::is_list() const { return axes.size() == 1 && axes.front().is_list(); }

bool ResultMap::is_poincare() const { return dimension == "state"; }

std::vector<std::string> ResultMap::column_names() const {
  if (parts.empty()) return {name};
  std::vector<std::string> names;
  const std::string stem = name.substr(0, name.find(':'));
  for (const ChannelInfo& part : parts) names.push_back(fmt::format("{}_{}", stem, part.name));
  return names;
}

}  // namespace gearsweep
