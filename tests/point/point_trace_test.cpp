// Traces of points, of studies with axes and without.
#include "point/point_trace.hpp"

#include <gtest/gtest.h>

#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

Study oscillator() {
  return read_study(
      "[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nvalues = [0.9, 1.1]\n"
      "[integrate]\nsettle = 20\nrecord = 3\n[observe]\nquantities = ['x_rms']\n",
      "test");
}

PointTraces traces_of(const Study& study, const std::vector<NamedValue>& values) {
  PointTraces found;
  EXPECT_TRUE(add_point_trace(study, false, find_place(study, values, ""), 32, {}, &found));
  return found;
}

TEST(PointTrace, HasItsLabelAndTheParametersOfItsPlace) {
  const PointTraces found = traces_of(oscillator(), {{"omega", 1.1}, {"x", 0.5}});
  EXPECT_EQ(found.labels, std::vector<std::string>{"omega=1.1, x=0.5"});
  EXPECT_EQ(found.placed, std::vector<std::string>{"omega"});
  EXPECT_EQ(found.traces.front().tau.size(), 96U);
}

TEST(PointTrace, OfAStudyWithoutAxesIsThatOfItsSetting) {
  Study study = oscillator();
  const PointTraces with = traces_of(study, {{"omega", 1.1}});
  study.axes.clear();
  EXPECT_EQ(traces_of(study, {{"omega", 1.1}}).traces.front().values, with.traces.front().values);
  study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter("omega"))] = 1.1;
  EXPECT_EQ(traces_of(study, {}).traces.front().values, with.traces.front().values);
}

// A tolerance that was asked for needs the step that a map has found.
TEST(PointTrace, TakesTheStepOfItsMap) {
  Study study = oscillator();
  const double own = study.integrate.max_step;
  study.integrate.tolerance = 1e-3;
  Study plain = study;
  settle_step(std::nullopt, &plain);
  EXPECT_EQ(plain.integrate.max_step, own);
  EXPECT_EQ(plain.integrate.tolerance, 0.0);
  study.integrate.is_tolerance_asked = true;
  EXPECT_THROW(settle_step(std::nullopt, &study), InputError);
  settle_step(0.07, &study);
  EXPECT_EQ(study.integrate.max_step, 0.07);
}

TEST(PointTrace, AddsNothingWhenItIsStopped) {
  const std::atomic<bool> stop = true;
  SweepOptions options;
  options.stop = &stop;
  PointTraces found;
  const Study study = oscillator();
  const Place place = find_place(study, {{"omega", 1.0}}, "");
  EXPECT_FALSE(add_point_trace(study, false, place, 32, options, &found));
  EXPECT_TRUE(found.traces.empty());
}

}  // namespace
}  // namespace gearsweep::testing
