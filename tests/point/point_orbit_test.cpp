// The orbit of a point and its branch, whole and stopped.
#include "point/point_orbit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/error.hpp"
#include "orbits/shooting.hpp"

namespace gearsweep::testing {
namespace {

// The pendulum doubles its period at damping 0.741173.
Study pendulum() {
  return read_study(
      "[model]\nname = 'pendulum'\npreset = 'cascade'\n[[axes]]\nname = 'damping'\n"
      "values = [0.745]\n[integrate]\nsettle = 300\n[observe]\nquantities = ['x_rms']\n",
      "test");
}

OrbitRequest request(const Study& study, double from, double to) {
  return {.place = find_place(study, {{"damping", 0.745}}, ""),
          .range = find_range(*study.model, "damping", from, to, "along"),
          .range_origin = "along",
          .period = {},
          .steps = 256};
}

std::vector<double> values_of(const OrbitLine& line) {
  std::vector<double> values;
  for (const BranchOrbit& member : line.orbits) values.push_back(member.parameter);
  return values;
}

// Downwards and upwards make one line, whichever end is asked for first.
TEST(PointOrbit, StandsInALineWithItsBranch) {
  const Study study = pendulum();
  for (const bool is_rising : {true, false}) {
    const OrbitRequest asked = is_rising ? request(study, 0.74, 0.75) : request(study, 0.75, 0.74);
    const OrbitFindings found = find_point_orbit(study, asked, {}).value();
    const OrbitLine line = orbits_of(found);
    std::vector<double> values = values_of(line);
    ASSERT_EQ(values.size(), found.branches[0].orbits.size() + found.branches[1].orbits.size() - 1);
    EXPECT_DOUBLE_EQ(values.at(line.start), 0.745);
    if (!is_rising) std::reverse(values.begin(), values.end());
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
    ASSERT_EQ(bifurcations_of(found).size(), 1U);
    EXPECT_EQ(bifurcations_of(found).front().kind, Bifurcation::flip);
    EXPECT_NEAR(bifurcations_of(found).front().parameter, 0.741173, 1e-5);
  }
}

TEST(PointOrbit, IsAloneWithoutARange) {
  const Study study = pendulum();
  OrbitRequest asked = request(study, 0.74, 0.75);
  asked.range.reset();
  const OrbitLine line = orbits_of(find_point_orbit(study, asked, {}).value());
  EXPECT_EQ(line.orbits.size(), 1U);
  EXPECT_EQ(line.start, 0U);
}

TEST(PointOrbit, OfAStudyWithoutAxesIsThatOfItsSetting) {
  Study study = pendulum();
  OrbitRequest asked = request(study, 0.74, 0.75);
  asked.range.reset();
  const OrbitFindings with = find_point_orbit(study, asked, {}).value();
  study.axes.clear();
  study.setting.parameters[asked.place.values.front().index] = 0.745;
  asked.place.values.clear();
  const OrbitFindings without = find_point_orbit(study, asked, {}).value();
  EXPECT_EQ(with.orbit.state, without.orbit.state);
}

TEST(PointOrbit, IsNotFoundWhenItIsStopped) {
  const Study study = pendulum();
  const std::atomic<bool> stop = true;
  SweepOptions options;
  options.stop = &stop;
  EXPECT_FALSE(find_point_orbit(study, request(study, 0.74, 0.75), options));
}

// The search itself, too, which takes longer than the settling before.
TEST(PointOrbit, EveryMapOfASearchStops) {
  const Study study = pendulum();
  const std::atomic<bool> stop = true;
  const PeriodMap map(*study.model, study.setting, 256, &stop);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(map.advance(rest, 1), SearchStopped);
  EXPECT_THROW(shoot(map, rest, 1), SearchStopped);
  const PeriodMap free(*study.model, study.setting, 256);
  const Orbit orbit = shoot(free, rest, 1).value();
  EXPECT_THROW(follow_orbit({study.model, study.setting, 0, 0.1, 0.9, 256, true, &stop}, orbit),
               SearchStopped);
}

TEST(PointOrbit, StartsInItsRange) {
  const Study study = pendulum();
  try {
    find_point_orbit(study, request(study, 0.5, 0.6), {});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "damping = 0.745 is not in the range of along");
  }
}

}  // namespace
}  // namespace gearsweep::testing
