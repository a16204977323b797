// gearsweep top: the peaks of a map, at places that trace takes; export and zoom, which go on from
// there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class TopTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(gearsweep(folder_,
                        "run coarse-map -o map.nc --quiet --set axes.omega.count=12 --set "
                        "axes.e0.count=8 --set integrate.settle=5 --set integrate.record=3")
                  .status,
              0);
  }

  void expect_refused(const std::string& arguments, const std::string& message) const {
    const Outcome outcome = gearsweep(folder_, arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << arguments;
  }

  Folder folder_;
};

TEST_F(TopTest, ItsPlacesArePointsOfTheMap) {
  const Outcome top = gearsweep(folder_, "top map.nc -q dmf_max -n 2 --json");
  ASSERT_EQ(top.status, 0) << top.err;
  const nlohmann::json peaks = nlohmann::json::parse(top.out).at("peaks");
  ASSERT_GE(peaks.size(), 1U);
  const std::string place = peaks[0].at("argument");
  EXPECT_THAT(gearsweep(folder_, "top map.nc -q dmf_max").out, HasSubstr("  " + place));
  const Outcome trace = gearsweep(folder_, "trace map.nc --at " + place + " -o trace.csv");
  EXPECT_EQ(trace.status, 0) << trace.err;
  // Its largest force is that of the map, at a row of the table.
  gearsweep(folder_, "export map.nc -q dmf_max -o dmf.csv");
  const std::string row = nlohmann::json(peaks[0].at("at").at("omega")).dump() + "," +
                          nlohmann::json(peaks[0].at("at").at("e0")).dump() + "," +
                          nlohmann::json(peaks[0].at("value")).dump() + "\n";
  EXPECT_THAT(read_all(folder_ / "dmf.csv"), HasSubstr("\n" + row));
}

TEST_F(TopTest, TheLeastComesWithSmallest) {
  const auto value = [&](const std::string& options) -> double {
    const Outcome top = gearsweep(folder_, "top map.nc -q x1_rms -n 1 --json" + options);
    return nlohmann::json::parse(top.out).at("peaks").at(0).at("value");
  };
  EXPECT_LT(value(" --smallest"), value(""));
}

TEST_F(TopTest, FewerPeaksThanWereAskedForAreToldOf) {
  const Outcome top = gearsweep(folder_, "top map.nc -q x1_rms -n 40 --apart 1");
  EXPECT_EQ(top.status, 0);
  EXPECT_THAT(top.out, HasSubstr("the largest point, "));
  EXPECT_THAT(top.err, HasSubstr("a smaller --apart may find more"));
}

TEST_F(TopTest, WrongInputIsRefused) {
  expect_refused("top map.nc -q x1_rsm", "did you mean 'x1_rms'?");
  expect_refused("top map.nc", "needs --quantity QUANTITY");
  expect_refused("top map.nc -q x1_rms -n 0", "'0' is not a whole number from 1");
  expect_refused("top map.nc -q x1_rms --apart 2", "'2' is not a number from 0 to 1");
  expect_refused("top none.nc -q x1_rms", "none.nc");
  ASSERT_EQ(gearsweep(folder_,
                      "run coarse-bifurcation -o line.nc --quiet --set axes.omega.count=4 --set "
                      "integrate.settle=5 --set integrate.record=3")
                .status,
            0);
  expect_refused("top line.nc -q poincare", "several numbers for each point");
  EXPECT_EQ(gearsweep(folder_, "top line.nc -q x1_rms").status, 0);
}

TEST_F(TopTest, ExportWritesSeveralQuantitiesOrAll) {
  ASSERT_EQ(gearsweep(folder_, "export map.nc -q dmf_max,contact_class -o two.csv").status, 0);
  EXPECT_THAT(read_all(folder_ / "two.csv"),
              StartsWith("omega [varpi],e0 [b_n],dmf_max [k0 b_n],contact_class\n"));
  ASSERT_EQ(gearsweep(folder_, "export map.nc -o all.csv").status, 0);
  EXPECT_THAT(read_all(folder_ / "all.csv"),
              HasSubstr(",x1_rms [b_n],x1_std [b_n],contact_class,"));
  expect_refused("export map.nc -q dmf_max,x1_rsm -o no.csv", "did you mean 'x1_rms'?");
  expect_refused("export map.nc -q dmf_max,dmf_max -o no.csv", "listed twice");
  expect_refused("export map.nc -q dmf_max, -o no.csv", "no quantity ''");
  EXPECT_EQ(folder_.files().count("no.csv"), 0U);
}

TEST_F(TopTest, AZoomIsTheStudyOverAnotherBox) {
  const Outcome zoom = gearsweep(folder_, "run map.nc --zoom omega=1.5:1.9,e0=0.3:0.5:3 --quiet");
  ASSERT_EQ(zoom.status, 0) << zoom.err;
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"map.nc", "map-zoom.nc"}));
  gearsweep(folder_, "export map-zoom.nc -q x1_rms -o zoom.csv");
  const std::string table = read_all(folder_ / "zoom.csv");
  EXPECT_THAT(table, HasSubstr("\n1.5,0.3,"));
  EXPECT_THAT(table, HasSubstr("\n1.9,0.5,"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 12 * 3);
  // The file holds the zoomed study.
  ASSERT_EQ(gearsweep(folder_, "run map-zoom.nc -o again.nc --quiet").status, 0);
  gearsweep(folder_, "export again.nc -q x1_rms -o again.csv");
  EXPECT_EQ(read_all(folder_ / "again.csv"), table);
}

TEST_F(TopTest, AZoomWithoutAnOutputReplacesNoOther) {
  const std::string run = "run map.nc --quiet --zoom ";
  ASSERT_EQ(gearsweep(folder_, run + "omega=1.5:1.9:3").status, 0);
  EXPECT_EQ(gearsweep(folder_, run + "omega=1.5:1.9:3").status, 0) << "it is the same";
  expect_refused(run + "omega=1.6:1.8:3", "map-zoom.nc: holds the result of another study");
  const Outcome given = gearsweep(folder_, run + "omega=1.6:1.8:3 -o map-zoom.nc");
  EXPECT_EQ(given.status, 0);
  EXPECT_THAT(given.err, HasSubstr("map-zoom.nc holds the result of another study, 'Coarse gear "
                                   "pair'; this run will replace it"));
  expect_refused(run + "omega=1:2 -o map.nc", "would replace its own study");
}

TEST_F(TopTest, AZoomThatIsNoneIsRefused) {
  expect_refused("run map.nc --zoom omega=2:1", "--zoom omega=2:1: 1 is not greater than 2");
  expect_refused("run map.nc --zoom mu=0:1", "the study has no axis 'mu'");
  expect_refused("run map.nc --zoom omega=1:2,", "expected AXIS=FROM:TO");
  EXPECT_EQ(folder_.files(), std::set<std::string>{"map.nc"});
}

TEST_F(TopTest, AResultOfAnotherStudyIsReplacedWithAWarning) {
  const std::string run =
      "run coarse-map -o map.nc --quiet --set axes.omega.count=12 --set axes.e0.count=8 --set "
      "integrate.settle=5 --set integrate.record=";
  EXPECT_EQ(gearsweep(folder_, run + "3").err, "");
  EXPECT_THAT(gearsweep(folder_, run + "4 --dry-run").err, Not(HasSubstr("replace")));
  EXPECT_EQ(gearsweep(folder_, run + "4").err,
            "gearsweep: warning: map.nc holds the result of another study, 'Coarse gear pair'; "
            "this run will replace it\n");
  EXPECT_EQ(gearsweep(folder_, run + "4").err, "");
}

TEST_F(TopTest, WhatAnAxisWinsOverIsToldOnce) {
  EXPECT_EQ(gearsweep(folder_,
                      "run map.nc -o again.nc --quiet --set parameters.e0=0.3 --set "
                      "axes.omega.count=2")
                .err,
            "gearsweep: warning: --set parameters.e0=0.3: the axis 'e0' of the study wins\n");
}

}  // namespace
}  // namespace gearsweep::testing
