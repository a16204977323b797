// The table of initial policies.
#include "study/initial_policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;

TEST(InitialPolicies, EachStandsInItsRow) {
  for (std::size_t i = 0; i < initial_policies().size(); ++i) {
    EXPECT_EQ(initial_policies()[i].policy, static_cast<InitialPolicy>(i));
  }
  EXPECT_EQ(info_of(InitialPolicy::backward).name, "backward");
}

TEST(InitialPolicies, AreWithOrWithoutANeighbour) {
  EXPECT_THAT(policy_names(), ElementsAre("fixed", "shifted", "forward", "backward"));
  EXPECT_THAT(policy_names(false), ElementsAre("fixed", "shifted"));
  EXPECT_THAT(policy_names(true), ElementsAre("forward", "backward"));
}

}  // namespace
}  // namespace gearsweep::testing
