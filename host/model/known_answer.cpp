#include "model/known_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gearsweep {

std::string describe_place(const KnownAnswer& answer) {
  std::vector<std::string> parts;
  for (const auto& [name, choice] : answer.choices) {
    parts.push_back(fmt::format("{} {}", name, choice));
  }
  for (const auto& [name, value] : answer.at) {
    parts.push_back(fmt::format("{} = {:.9g}", name, value));
  }
  if (answer.starts > 1) parts.push_back(fmt::format("mean of {} starts", answer.starts));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace gearsweep
