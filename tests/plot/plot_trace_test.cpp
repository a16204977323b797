// Pictures of traces: each kind is drawn without complaint and shows what its name says.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "plot/trace_picture_test.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::count_of;
using gearsweep::testing::made_trace;
using gearsweep::testing::PlotTraceTest;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(PlotTraceTest, ForceSaysWhatAModelOfOnesOwnLacks) {
  const auto refusal_with = [&](Role role, const std::string& contact) {
    Trace trace = made_trace(study_, 20, 16);
    trace.channels[2].role = role;
    trace.channels[3].name = contact;
    return refused({write("own.nc", {trace}, {"omega=0.5"})}, "force");
  };
  EXPECT_THAT(refusal_with(Role::none, "contact"), AllOf(HasSubstr("name a channel: -q force:NAME"),
                                                         HasSubstr("role = \"mesh_force\"")));
  EXPECT_THAT(refusal_with(Role::mesh_force, "left_contact"),
              HasSubstr("-q time:left_contact draws one"));
  EXPECT_THAT(refusal_with(Role::mesh_force, "depth"), HasSubstr("neither backlash nor stop"));
}

TEST_F(PlotTraceTest, TheForceMayHaveAnyName) {
  Trace trace = made_trace(study_, 20, 16);
  trace.channels[2].name = "push";
  const std::string path = write("own.nc", {trace}, {"omega=0.5"});
  EXPECT_THAT(script_of({path}, "force"),
              AllOf(HasSubstr("\"push ("), HasSubstr("time (mesh periods)")));
  EXPECT_THAT(script_of({path}, "portrait"), HasSubstr("force and flanks"));
}

TEST_F(PlotTraceTest, OnlyGearsHaveMeshPeriods) {
  Trace trace = made_trace(study_, 20, 16);
  trace.channels[2].role = Role::none;
  EXPECT_THAT(script_of({write("own.nc", {trace}, {"omega=0.5"})}, ""),
              HasSubstr("time (forcing periods)"));
}

TEST_F(PlotTraceTest, TimeIsTheDefaultAndShowsTheLastPeriods) {
  const std::string path = write_one();
  EXPECT_THAT(script_of({path}, ""),
              AllOf(HasSubstr("\"position {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                    HasSubstr("time (mesh periods)"), HasSubstr("set xrange [0:10]"),
                    HasSubstr("the last 10 periods"), HasSubstr("two gears"),
                    HasSubstr("at {/:Italic ω} = 0.5")));
  EXPECT_EQ(data().size(), 2U * 10U * 16U);
  PlotRequest three = request({path}, "time:v1");
  three.periods = 3;
  EXPECT_THAT(script_of(three),
              AllOf(HasSubstr("set xrange [0:3]"), HasSubstr("{/:Italic v}_{1}")));
  EXPECT_NEAR(data()[1], 1.0, 1e-12);  // cos of whole turns, to rounding
  three.periods = 30;
  EXPECT_THAT(script_of(three), AllOf(HasSubstr("set xrange [0:20]"), Not(HasSubstr("the last"))));
}

TEST_F(PlotTraceTest, APhasePortraitHasTheSectionsPoints) {
  const std::string script = script_of({write_one()}, "phase");
  EXPECT_THAT(script,
              AllOf(HasSubstr("\"position {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                    HasSubstr("\"velocity {/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})\""),
                    HasSubstr("record=(320)"), HasSubstr("record=(20)"), HasSubstr("\"phase 0\"")));
  // After the curve: sin and cos at phase 0, to rounding.
  const std::vector<double> numbers = data();
  for (std::size_t i = 640; i < numbers.size(); i += 2) {
    EXPECT_NEAR(numbers[i], 0.0, 1e-12);
    EXPECT_NEAR(numbers[i + 1], 1.0, 1e-12);
  }
  EXPECT_EQ(numbers.size(), 2U * (320U + 20U));
  EXPECT_THAT(script_of({write_one()}, "phase:dmf:x1"),
              AllOf(HasSubstr("\"meshing force ("), HasSubstr("position {/:Italic x}_{1} (")));
}

// Names mean nothing: the file says which state is the rate of which.
TEST_F(PlotTraceTest, APhasePortraitIsOverTheStateWhoseRateIsDrawn) {
  Trace trace = made_trace(study_, 20, 16);
  trace.channels[0] = {"angle", "rad", "where it is"};
  trace.channels[2] = {"x7", "rad", "where it is", Role::none, "v1"};
  const std::string path = write("named.nc", {trace}, {"omega=0.5"});
  EXPECT_THAT(script_of({path}, "phase"), AllOf(HasSubstr("\"where it is {/:Italic x}_{7} (rad)\""),
                                                HasSubstr("\"velocity {/:Italic v}_{1} (")));
  EXPECT_EQ(read_traces(path)[0].trace.channels[2].velocity, "v1");
  EXPECT_THAT(refused({path}, "phase:angle"), HasSubstr("has no velocity beside it"));
}

// Moments of steps: the end of one and the start of the next are the same.
TEST_F(PlotTraceTest, ASectionTakesEachPeriodOnce) {
  Trace trace = made_trace(study_, 5, 16);
  trace.tau.insert(trace.tau.begin() + 32, trace.tau[32]);
  for (std::vector<double>& values : trace.values) {
    values.insert(values.begin() + 32, values[32]);
  }
  const std::string script = script_of({write("steps.nc", {trace}, {""})}, "section");
  EXPECT_THAT(script, AllOf(HasSubstr("record=(5)"), HasSubstr("at phase 0 of each period")));
  EXPECT_EQ(data().size(), 2U * 5U);
}

TEST_F(PlotTraceTest, ASpectrumIsInDecibelsOverTheOrder) {
  PlotRequest spectrum = request({write_one()}, "spectrum:x1");
  EXPECT_THAT(script_of(spectrum),
              AllOf(HasSubstr("position {/:Italic x}_{1} (dB re 1 {/:Italic b}_{n})\""),
                    HasSubstr("mesh frequency"), HasSubstr("set xrange [0:10]"),
                    Not(HasSubstr("the last"))));
  const std::vector<double> numbers = data();
  ASSERT_EQ(numbers.size(), 2U * (160U + 1U));
  EXPECT_NEAR(numbers[40], 1.0, 1e-12);  // rounding
  EXPECT_NEAR(numbers[41], 0.0, 1e-9);   // a sine of amplitude 1 is 0 dB
  spectrum.orders = 3.0;
  EXPECT_THAT(script_of(spectrum), HasSubstr("set xrange [0:3]"));
}

TEST_F(PlotTraceTest, ASpectrumMarksTheOrdersOfASecondMesh) {
  const Study study = read_study(
      "[model]\nname = 'two_stages'\n[[axes]]\nname = 'omega'\nvalues = [0.5]\n", "test");
  const std::string path = in_folder("stages.nc");
  write_traces({made_trace(study, 20, 16)}, {"omega=0.5"}, {}, study, path,
               gearsweep::testing::kProvenance);
  EXPECT_THAT(script_of({path}, "spectrum:x1"),
              AllOf(HasSubstr("with vectors nohead"), HasSubstr("orders of second"),
                    HasSubstr("mesh frequency of first")));
  const std::vector<double> numbers = data();
  const std::size_t lines = 22;  // of orders up to 10: 22 times 18/41 are 9.66
  ASSERT_GE(numbers.size(), 4U * lines);
  for (std::size_t k = 0; k < lines; ++k) {
    EXPECT_NEAR(numbers[numbers.size() - 4U * (lines - k)],
                static_cast<double>(k + 1) * 18.0 / 41.0, 1e-12);
  }
}

TEST_F(PlotTraceTest, ForceShowsWhereBothFlanksTouch) {
  Trace trace = made_trace(study_, 2, 16);
  for (double& contact : trace.values[3]) contact *= 2.0;
  const std::string path = write("wedged.nc", {trace}, {"omega=0.5"});
  const std::string free = write("free.nc", {made_trace(study_, 2, 16)}, {"b=9"});
  EXPECT_THAT(script_of({path}, "force"),
              AllOf(HasSubstr("\"both flanks (wedged)\""), Not(HasSubstr("\"drive flank\""))));
  EXPECT_THAT(script_of({path, free}, "force"), HasSubstr("\"both flanks (wedged)\""));
}

TEST_F(PlotTraceTest, ForceHasTheFlanksBehindIt) {
  const std::string one = script_of({write_one(2)}, "force");
  EXPECT_THAT(one, AllOf(HasSubstr("meshing force ({/:Italic k}_{0}{/:Italic b}_{n})"),
                         HasSubstr("\"drive flank\""), HasSubstr("\"no contact\""),
                         Not(HasSubstr("back flank"))));
  // The first band of the drive flank: from half a step after 0 to half a step after sin is last
  // above 0.1, moment 7 of 16; over the whole height.
  const std::vector<double> numbers = data();
  EXPECT_NEAR(numbers[2], 0.5 / 16.0, 1e-12);  // rounding
  EXPECT_NEAR(numbers[3], 7.5 / 16.0, 1e-12);
  EXPECT_EQ(numbers[5], 1.0);
}

// varpi = 1e4 rad/s: a period of 2.5 in the model's time takes 0.25 ms.
TEST_F(PlotTraceTest, OfAGearWithScalesTimeIsInMilliseconds) {
  study_.scales = {1e4, 5e-5, 2e8, 3000.0};
  const std::string path = write_one(4);
  EXPECT_THAT(script_of({path}, "time:dmf"), AllOf(HasSubstr("time (ms)"), HasSubstr("(N)")));
  const double last = data()[data().size() - 2];
  EXPECT_DOUBLE_EQ(last, 0.25 * (4.0 - 1.0 / 16.0));  // the last of 16 moments of the fourth period
  PlotRequest model = request({path}, "time:dmf");
  model.style.has_units = true;
  EXPECT_THAT(script_of(model), HasSubstr("time (mesh periods)"));
}

// So many turns over one another are a density, fewer are lines.
TEST_F(PlotTraceTest, APhasePortraitOfManyPeriodsIsADensity) {
  EXPECT_THAT(
      script_of({write_one(300)}, "phase"),
      AllOf(HasSubstr("with image"), HasSubstr("more often there"), Not(HasSubstr("with lines"))));
  std::size_t seen = 0;
  for (const double shade : data()) {
    if (std::isnan(shade)) continue;
    ++seen;
    EXPECT_GT(shade, 0.0);
    EXPECT_LE(shade, 1.0);
  }
  EXPECT_GT(seen, 100U);
  EXPECT_THAT(script_of({write_one(100)}, "phase"), HasSubstr("with lines"));
}

TEST_F(PlotTraceTest, NoLineJoinsBothSidesOfAnImpact) {
  Trace trace = made_trace(study_, 2, 16);
  const std::size_t moments = trace.tau.size();
  trace.tau[5] = trace.tau[4];
  trace.channels.push_back({kEvents, "1", "1 wall, which resets the state; 0 none"});
  trace.values.emplace_back(moments);
  trace.values.back()[4] = trace.values.back()[5] = 1.0;
  const std::string exact = write("exact.nc", {trace}, {"omega=0.5"});
  EXPECT_THAT(script_of({exact}, "time:x1"),
              AllOf(HasSubstr(fmt::format("record=({})", moments + 1)), HasSubstr("record=(2)"),
                    HasSubstr("\"at a surface\"")));
  EXPECT_TRUE(std::isnan(data()[2 * 5]));
  // Where moments are even, the one behind it is marked.
  Trace even = made_trace(study_, 2, 16);
  even.channels.push_back(trace.channels.back());
  even.values.emplace_back(moments);
  even.values.back()[5] = 1.0;
  const std::string path = write("even.nc", {even}, {"omega=0.5"});
  EXPECT_THAT(script_of({path}, "phase:x1:v1"), HasSubstr(fmt::format("record=({})", moments + 1)));
  EXPECT_TRUE(std::isnan(data()[2 * 5]));
  even.values.back()[5] = -1.0;  // a jump of the equations leaves the state
  EXPECT_THAT(script_of({write("even.nc", {even}, {"omega=0.5"})}, "phase:x1:v1"),
              HasSubstr(fmt::format("record=({})", moments)));
}

TEST_F(PlotTraceTest, WithoutForcingTimeIsTimeAndThereIsNoPhase) {
  Trace free = made_trace(study_, 20, 16);
  free.is_clockless = true;
  free.channels.resize(2);
  free.values.resize(2);
  const std::string path = write("free.nc", {free}, {""});
  const std::string script = script_of({path}, "portrait");
  EXPECT_EQ(count_of("\nplot ", script), 4U);
  EXPECT_THAT(script, AllOf(HasSubstr("\"time\""), HasSubstr("frequency (1/time)"),
                            Not(HasSubstr("phase 0")), Not(HasSubstr("forcing"))));
  EXPECT_THAT(refused({path}, "section"), HasSubstr("this model has none"));
  const std::string forced = write("forced.nc", {made_trace(study_, 20, 16)}, {""});
  EXPECT_THAT(refused({path, forced}, "time"), HasSubstr("another is not"));
}

TEST_F(PlotTraceTest, TracesOfOneFileOrOfSeveralLieOverOneAnother) {
  const Trace trace = made_trace(study_, 4, 16);
  const std::string two = write("two.nc", {trace, trace}, {"mu=0", "mu=0.1"});
  const std::string one = write("one.nc", {trace}, {"mu=0.1"});
  for (const char* const quantity : {"time", "phase", "section", "spectrum", "force", "portrait"}) {
    EXPECT_THAT(script_of({two}, quantity),
                AllOf(HasSubstr("\"{/:Italic μ} = 0\""), HasSubstr("\"{/:Italic μ} = 0.1\"")))
        << quantity;
  }
  // The same label does not tell them apart, so the files do.
  const std::string other = write("other.nc", {trace}, {"mu=0.1"});
  EXPECT_THAT(script_of({one, other}, "time"), AllOf(HasSubstr("\"one\""), HasSubstr("\"other\""),
                                                     HasSubstr("at {/:Italic μ} = 0.1")));
}

TEST_F(PlotTraceTest, WhatCannotBeDrawnIsRefusedAndLeavesNoFile) {
  const std::string path = write_one();
  EXPECT_THAT(refused({path}, "tme"), HasSubstr("did you mean 'time'?"));
  EXPECT_THAT(refused({path}, "time:dfm"), HasSubstr("did you mean 'dmf'?"));
  EXPECT_THAT(refused({path}, "time:x1:v1"), HasSubstr("one channel"));
  EXPECT_THAT(refused({path}, "phase:dmf"), HasSubstr("phase:dmf:x1"));
  EXPECT_THAT(refused({path}, "portrait:dmf"), HasSubstr("portrait:dmf:x1"));
  EXPECT_THAT(refused({path}, "phase:x2"), HasSubstr("no channel 'x2'"));
  EXPECT_THAT(refused({write("short.nc", {made_trace(study_, 1, 16)}, {""}), path}, "phase:x1:x2"),
              HasSubstr("no channel 'x2'"));
  Trace part = made_trace(study_, 1, 16);
  part.tau.resize(9);
  for (std::vector<double>& values : part.values) values.resize(9);
  EXPECT_THAT(refused({write("part.nc", {part}, {""})}, "spectrum"),
              HasSubstr("9 of its 16 moments"));
  part.tau[3] += 0.01;
  EXPECT_THAT(refused({write("part.nc", {part}, {""})}, "spectrum"),
              HasSubstr("--samples-per-period 256"));
  Trace free = made_trace(study_, 1, 16);
  free.channels.pop_back();
  free.values.pop_back();
  EXPECT_THAT(refused({write("free.nc", {free}, {""})}, "force"),
              HasSubstr("neither backlash nor stop"));
  EXPECT_THAT(refused({path, path, path, path, path, path, path}, "time"), HasSubstr("7 are too"));
  PlotRequest cut = request({path}, "time");
  cut.at = {{"b", 1.0}};
  EXPECT_THAT(refusal([&] { plot_files(cut); }), HasSubstr("--at"));
  PlotRequest orders = request({path}, "time");
  orders.orders = 3.0;
  EXPECT_THAT(refusal([&] { plot_files(orders); }), HasSubstr("spectra"));
  const std::string map = IoTest::write(gearsweep::testing::example_result());
  EXPECT_THAT(refused({path, map}, "time"), HasSubstr("some of the files hold maps"));
  EXPECT_THAT(refused({path, in_folder("none.nc")}, "time"), HasSubstr("none.nc"));
  EXPECT_EQ(files(), 5U);
}

}  // namespace
}  // namespace gearsweep
