// Portraits: several pictures of one trace on a page.
#include <gmock/gmock.h>

#include <set>

#include "plot/trace_picture_test.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::count_of;
using gearsweep::testing::made_trace;
using gearsweep::testing::PlotTraceTest;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A column of the width of a page's has its four panels below one another.
TEST_F(PlotTraceTest, ANarrowPortraitHasOneColumn) {
  PlotRequest narrow = request({write_one()}, "portrait");
  narrow.style.size.width = 85.0;
  const std::string script = script_of(narrow);
  const auto frames = [&] {
    std::set<std::string> lefts;
    for (std::size_t at = 0; (at = script.find("set lmargin at screen ", at)) != std::string::npos;
         ++at) {
      lefts.insert(script.substr(at, script.find('\n', at) - at));
    }
    return lefts.size();
  };
  EXPECT_EQ(frames(), 1U);
  narrow.style.size.height = 40.0;
  EXPECT_THAT(refusal([&] { plot_files(narrow); }), HasSubstr("no room for the picture"));
}

TEST_F(PlotTraceTest, APortraitHasHistoryPhaseForceAndSpectrum) {
  const std::string script = script_of({write_one()}, "portrait");
  EXPECT_EQ(count_of("\nplot ", script), 4U);
  EXPECT_THAT(script,
              AllOf(HasSubstr("(a) "), HasSubstr("time history"), HasSubstr("phase portrait"),
                    HasSubstr("\"phase 0\""), HasSubstr("\"drive flank\""),
                    HasSubstr("meshing force ("), HasSubstr("(dB re 1 "), HasSubstr("(d) ")));
  // The histories are of the last 10 periods; phase portrait and spectrum are of all 20.
  EXPECT_EQ(count_of("set xrange [0:10]", script), 3U);  // the spectrum's orders, too
  EXPECT_EQ(count_of("record=(160)", script), 2U);
  EXPECT_THAT(script, AllOf(HasSubstr("record=(320)"), HasSubstr("record=(161)"),
                            Not(HasSubstr("the last"))));
  PlotRequest chosen = request({write_one()}, "portrait:x1:dmf");
  chosen.periods = 3;
  chosen.orders = 4.0;
  const std::string other = script_of(chosen);
  EXPECT_EQ(count_of("set xrange [0:3]", other), 2U);
  EXPECT_EQ(count_of("set xrange [0:4]", other), 1U);
  EXPECT_EQ(count_of("meshing force (", other), 2U);  // over x1, and as the force
}

// They are of four different pairs of axes.
TEST_F(PlotTraceTest, APortraitsLimitsAndLabelsAreTheHistorys) {
  PlotRequest limited = request({write_one()}, "portrait");
  limited.style.xrange = {2.0, 4.0};
  limited.style.yrange = {-5.0, 5.0};
  limited.style.xlabel = "turns";
  limited.style.ylabel = "way";
  const std::string script = script_of(limited);
  EXPECT_EQ(count_of("set xrange [2:4]", script), 2U);  // the force's, too
  EXPECT_EQ(count_of("\"turns\"", script), 2U);
  EXPECT_EQ(count_of("set yrange [-5:5]", script), 1U);
  EXPECT_EQ(count_of("\"way\"", script), 1U);
}

TEST_F(PlotTraceTest, APortraitForPrintCallsItsPanelsByLetters) {
  PlotRequest print = request({write_one()}, "portrait");
  print.style.size.width = 170.0;
  EXPECT_THAT(script_of(print), AllOf(HasSubstr("\"(d)\""), Not(HasSubstr("time history"))));
  print.style.size = {170.0, 20.0};
  EXPECT_THAT(refusal([&] { plot_files(print); }), HasSubstr("no room"));
}

TEST_F(PlotTraceTest, APortraitWithoutFlanksHasASectionInTheirPlace) {
  Trace free = made_trace(study_, 20, 16);
  free.channels.resize(2);
  free.values.resize(2);
  const std::string script = script_of({write("free.nc", {free}, {""})}, "portrait");
  EXPECT_EQ(count_of("\nplot ", script), 4U);
  EXPECT_THAT(script, AllOf(HasSubstr("section at phase 0"), Not(HasSubstr("flank"))));
}

}  // namespace
}  // namespace gearsweep
