// Where points start: the policies that a study chooses from.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// To add one, give it a row in initial_policies(), which says what each means, and its start in
// Plan::start_of_policy(), where the compiler misses a case.
enum class InitialPolicy { fixed, shifted, forward, backward };

struct InitialPolicyInfo {
  InitialPolicy policy;
  std::string name;     // in a study
  std::string meaning;  // where a point starts
  // The neighbour that a point goes on from, along one axis: -1 for the one before it, 1 for the
  // one behind it; 0: none.
  int neighbour;
};

// All, in the order of the enumerators.
const std::vector<InitialPolicyInfo>& initial_policies();

const InitialPolicyInfo& info_of(InitialPolicy policy);

std::vector<std::string> policy_names();
// Policies whose points go on from a neighbour, or those whose points do not.
std::vector<std::string> policy_names(bool has_neighbour);

}  // namespace gearsweep
