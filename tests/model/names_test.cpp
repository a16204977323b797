// Help with mistyped names.
#include "model/names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::vector<std::string> kKnown = {"omega", "zeta", "teeth_ratio", "b", "mu"};

TEST(SuggestName, FindsTheNearest) {
  EXPECT_EQ(suggest_name("omgea", kKnown), "; did you mean 'omega'?");
  EXPECT_EQ(suggest_name("Omega", kKnown), "; did you mean 'omega'?");
  EXPECT_EQ(suggest_name("teeth-ratio", kKnown), "; did you mean 'teeth_ratio'?");
}

// Whoever leaves out a unit, or what a speed is of.
TEST(SuggestName, FindsLongerNamesOfTheSameWords) {
  const std::vector<std::string> known = {"mass_kg", "pinion_speed_rpm", "bearing_stiffness",
                                          "bearing_damping", "massive"};
  EXPECT_EQ(suggest_name("mass", known), "; did you mean 'mass_kg'?");
  EXPECT_EQ(suggest_name("Speed_rpm", known), "; did you mean 'pinion_speed_rpm'?");
  EXPECT_EQ(suggest_name("bearing", known),
            "; did you mean 'bearing_stiffness' or 'bearing_damping'?");
}

TEST(SuggestName, ListsWhatIsKnownWhenNothingIsNear) {
  EXPECT_EQ(suggest_name("friction", kKnown), "; known: omega, zeta, teeth_ratio, b, mu");
}

// One letter is one edit away from any other: that is no resemblance.
TEST(SuggestName, DoesNotSuggestASingleLetter) {
  EXPECT_THAT(suggest_name("q", kKnown), Not(HasSubstr("did you mean 'b'")));
}

TEST(SuggestName, ShortensLongLists) {
  const std::vector<std::string> many(20, "something");
  EXPECT_THAT(suggest_name("x", many), ::testing::EndsWith(", ..."));
  EXPECT_EQ(suggest_name("x", {}), "");
}

// By the whole length this would take terabytes of memory.
TEST(SuggestName, TakesNamesOfAnyLength) {
  const std::string enormous(10'000'000, 'o');
  EXPECT_EQ(suggest_name(enormous, {"b", "mu"}), "; known: b, mu");
  EXPECT_EQ(suggest_name("omgea", {enormous + enormous, "omega"}), "; did you mean 'omega'?");
  EXPECT_EQ(suggest_name(enormous, {enormous + "a"}), "; did you mean '" + enormous + "a'?");
}

TEST(SplitWords, SplitsAtBlanks) {
  EXPECT_THAT(split_words("consistent  printed "), ElementsAre("consistent", "printed"));
  EXPECT_THAT(split_words(""), IsEmpty());
}

}  // namespace
}  // namespace gearsweep::testing
