// What is given twice is told of, with what wins; what is not, is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/builtin_studies.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const kStudy = "[[axes]]\nname = 'e0'\nvalues = [0.1, 0.2]\n";

std::string gear_study(const std::string& parameters) {
  std::string text = builtin_studies().at("table1-gear.toml");
  const std::string mark = "[parameters]\n";
  return text.insert(text.find(mark) + mark.size(), parameters);
}

// Without a clock the section is that by which motions are judged, too.
TEST(Notices, TellHowNothingIsSampled) {
  const auto notices = [](const std::string& model, const std::string& observe) {
    return read_study("[model]\nname = '" + model + "'\n[sections.up]\nwhen = 'v'\n[[axes]]\n" +
                          "name = 'x'\nvalues = [0.1]\n[observe]\n" + observe,
                      "s.toml")
        .notices;
  };
  const std::string rms = "quantities = ['x_rms']\n";
  EXPECT_THAT(notices("duffing", rms + "poincare = ['v']\nsection = 'up'\n"),
              ElementsAre(HasSubstr("observe.poincare says how 'poincare' is sampled"),
                          HasSubstr("observe.section says how 'poincare' is sampled")));
  EXPECT_THAT(notices("jerk", rms + "section = 'up'\n"), IsEmpty());
  EXPECT_THAT(notices("duffing", "quantities = ['poincare']\npoincare = ['v']\n"), IsEmpty());
}

TEST(Notices, AnAxisWinsOverTheCommandLine) {
  EXPECT_THAT(read_study(kStudy, "s.toml", {"parameters.e0=0.3"}).notices,
              ElementsAre("--set parameters.e0=0.3: the axis 'e0' of the study wins"));
  EXPECT_THAT(read_study("[[axes]]\nname = 'x1'\nvalues = [0.1]\n[initial]\npolicy = 'fixed'\n",
                         "s.toml", {"initial.state.x1=0.3"})
                  .notices,
              ElementsAre("--set initial.state.x1=0.3: the axis 'x1' of the study wins"));
  EXPECT_THAT(
      read_study(builtin_studies().at("table1-gear.toml"), "s.toml", {"gear.pinion_speed_rpm=3000"})
          .notices,
      ElementsAre("--set gear.pinion_speed_rpm=3000: the axis 'omega' of the study wins over what "
                  "follows from this"));
  EXPECT_THAT(read_study(kStudy, "s.toml", {"parameters.mu=0.3"}).notices, IsEmpty());
}

// Its draws are around what the study gives, and so is the nominal map.
TEST(Notices, AnUncertainParameterIsGivenOnce) {
  EXPECT_THAT(
      read_study(std::string(kStudy) + "[uncertain]\nmu = {distribution = 'normal', std = 0.001}\n",
                 "s.toml", {"parameters.mu=0.3"})
          .notices,
      IsEmpty());
}

TEST(Notices, AParameterWinsOverTheGearTable) {
  EXPECT_THAT(read_study(gear_study("e0 = 0.25\n"), "s.toml").notices,
              ElementsAre("s.toml:24: e0 = 0.25 wins over transmission_error_um of [gear], which "
                          "gives 0.6"));
  EXPECT_THAT(read_study(gear_study("eps = 1.6\n"), "s.toml").notices,
              ElementsAre("s.toml:24: eps = 1.6 wins over contact_ratio of [gear], which gives "
                          "1.718"));
  EXPECT_THAT(read_study(gear_study(""), "s.toml", {"parameters.zeta=0.1"}).notices,
              ElementsAre(::testing::HasSubstr("--set parameters.zeta=0.1: zeta = 0.1 wins over "
                                               "mesh_damping_N_s_per_mm of [gear]")));
  EXPECT_THAT(read_study(gear_study("q = 0.3\n"), "s.toml").notices, IsEmpty());
}

// As many mesh periods as a study of the mesh alone has, or a few more.
TEST(Notices, ALongPeriodShortensWhatIsNotSaid) {
  const std::string cycle = std::string(kStudy) + "[parameters]\nzp = 23\ncycle = 23\n";
  const Study study = read_study(cycle, "s.toml");
  EXPECT_EQ(study.integrate.settle, 18U);
  EXPECT_EQ(study.integrate.record, 9U);
  EXPECT_EQ(study.integrate.warm_up, 5U);
  EXPECT_EQ(study.integrate.extend, 16U);
  EXPECT_THAT(study.notices, ElementsAre("a period of this study is 23 mesh periods: unless given, "
                                         "settle = 18, record = 9, warm_up = 5 and extend = 16"));
  const Study given = read_study(cycle + "[integrate]\nsettle = 100\nrecord = 50\n", "s.toml");
  EXPECT_EQ(given.integrate.settle, 100U);
  EXPECT_THAT(given.notices, IsEmpty());
}

TEST(Notices, ThereAreNoneOfTheBuiltInStudies) {
  for (const auto& [name, text] : builtin_studies()) {
    EXPECT_THAT(read_study(text, name).notices, IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace gearsweep
