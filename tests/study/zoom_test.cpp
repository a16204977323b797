// A zoom gives an axis another stretch and leaves the rest of the study as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const kZoomedStudy =
    "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.0\ncount = 5\n"
    "[[axes]]\nname = 'b'\nvalues = [0.1, 0.7, 1.5]\n";

std::string refusal_of_zooms(const std::vector<std::string>& zooms,
                             const std::string& study = kZoomedStudy) {
  return gearsweep::testing::refusal(study, {}, zooms);
}

TEST(Zoom, AnAxisKeepsItsCount) {
  const Study study = read_study(kZoomedStudy, "s.toml", {}, {"omega=1:2"});
  EXPECT_THAT(study.axes[0].values, ElementsAre(1.0, 1.25, 1.5, 1.75, 2.0));
  EXPECT_THAT(study.axes[1].values, ElementsAre(0.1, 0.7, 1.5));
  EXPECT_THAT(study.notices, IsEmpty());
}

TEST(Zoom, AListOfValuesBecomesAStretch) {
  const Study study = read_study(kZoomedStudy, "s.toml", {}, {"b=0.5:1.5", "omega=1:1:1"});
  EXPECT_THAT(study.axes[0].values, ElementsAre(1.0));
  EXPECT_THAT(study.axes[1].values, ElementsAre(0.5, 1.0, 1.5));
}

TEST(Zoom, ACountMayBeGivenAndTheStretchMayBeOutside) {
  const Study study = read_study(kZoomedStudy, "s.toml", {}, {"omega=2:3:3"});
  EXPECT_THAT(study.axes[0].values, ElementsAre(2.0, 2.5, 3.0));
}

// One value in its place would be a map that nobody asked for.
TEST(Zoom, AnAxisWithoutACountOrWithAWrongOneIsRefusedAsEver) {
  const std::string axis = "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.0\n";
  EXPECT_THAT(refusal_of_zooms({"omega=1:2"}, axis),
              HasSubstr("axis 'omega' needs from, to and count"));
  EXPECT_THAT(refusal_of_zooms({"omega=1:2"}, axis + "count = 'x'\n"),
              HasSubstr("s.toml:5: axis 'omega': count must be"));
  EXPECT_EQ(read_study(axis + "count = 'x'\n", "s.toml", {}, {"omega=1:2:3"}).points(), 3U);
}

TEST(Zoom, ALogarithmicAxisStaysOne) {
  const Study study =
      read_study(kZoomedStudy, "s.toml", {"axes.omega.scale=log"}, {"omega=0.01:1:3"});
  EXPECT_THAT(study.axes[0].values, ElementsAre(0.01, ::testing::DoubleNear(0.1, 1e-15), 1.0));
}

TEST(Zoom, ItsTomlGivesTheSameStudy) {
  const Study study = read_study(kZoomedStudy, "s.toml", {}, {"b=0.3:0.4:7"});
  const Study again = read_study(study.toml, "again.toml");
  EXPECT_EQ(again.toml, study.toml);
  EXPECT_EQ(again.axes[1].values, study.axes[1].values);
}

TEST(Zoom, AChainThatBeginsElsewhereIsToldOf) {
  const std::string chained = std::string(kZoomedStudy) + "[initial]\npolicy = 'forward'\n";
  EXPECT_THAT(read_study(chained, "s.toml", {}, {"omega=1:2"}).notices,
              ElementsAre(HasSubstr("--zoom omega=1:2: the points of this study go on from their "
                                    "neighbours along 'omega'")));
  EXPECT_THAT(read_study(chained, "s.toml", {}, {"b=1:2"}).notices, IsEmpty());
}

TEST(Zoom, WhatIsNoStretchIsRefused) {
  EXPECT_THAT(refusal_of_zooms({"omega=1:2", "omega=1:3"}),
              HasSubstr("--zoom omega=1:3: axis 'omega' is zoomed twice"));
  EXPECT_THAT(refusal_of_zooms({"omga=1:2"}),
              AllOf(HasSubstr("--zoom omga=1:2: the study has no axis 'omga'"),
                    HasSubstr("did you mean 'omega'?")));
  EXPECT_THAT(refusal_of_zooms({"mu=0:0.1"}), HasSubstr("no axis 'mu'"));
  EXPECT_THAT(refusal_of_zooms({"omega=2:1"}), HasSubstr("1 is not greater than 2"));
  EXPECT_THAT(refusal_of_zooms({"omega=1:1"}), HasSubstr("1 is not greater than 1"));
  EXPECT_THAT(refusal_of_zooms({"omega=1:2:0"}), HasSubstr("count = 0; at least 1 is needed"));
  EXPECT_THAT(refusal_of_zooms({"omega=1:2:-3"}), HasSubstr("at least 1 is needed"));
  EXPECT_THAT(refusal_of_zooms({"omega=1:2:2000000"}), HasSubstr("at most 1000000"));
  EXPECT_THAT(refusal_of_zooms({"omega=-1:2"}),
              HasSubstr("--zoom omega=-1:2: from = -1 is out of range"));
  for (const char* wrong :
       {"omega", "omega=", "omega=1", "omega=1:", "omega=1:2:3:4", "omega=a:b", "omega=1:2:x",
        "omega=nan:2", "omega=1:inf", "omega=1:2:1.5", "omega=1 :2"}) {
    EXPECT_THAT(refusal_of_zooms({wrong}), HasSubstr("expected AXIS=FROM:TO or AXIS=FROM:TO:COUNT"))
        << wrong;
  }
}

}  // namespace
}  // namespace gearsweep
