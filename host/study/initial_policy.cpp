#include "study/initial_policy.hpp"

namespace gearsweep {

const std::vector<InitialPolicyInfo>& initial_policies() {
  using enum InitialPolicy;
  static const std::vector<InitialPolicyInfo> kAll = {
      {fixed, "fixed", "at state", 0},
      {shifted, "shifted", "at the start that its model gives for its parameters", 0},
      {forward, "forward", "where its neighbour before it along an axis has ended", -1},
      {backward, "backward", "where its neighbour behind it along an axis has ended", 1}};
  return kAll;
}

const InitialPolicyInfo& info_of(InitialPolicy policy) {
  return initial_policies().at(static_cast<std::size_t>(policy));
}

std::vector<std::string> policy_names() {
  std::vector<std::string> names;
  for (const InitialPolicyInfo& info : initial_policies()) names.push_back(info.name);
  return names;
}

std::vector<std::string> policy_names(bool has_neighbour) {
  std::vector<std::string> names;
  for (const InitialPolicyInfo& info : initial_policies()) {
    if ((info.neighbour != 0) == has_neighbour) names.push_back(info.name);
  }
  return names;
}

}  // namespace gearsweep
