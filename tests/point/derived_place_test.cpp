// Places of studies with parameters that follow others.
#include <gmock/gmock.h>

#include <numbers>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "point/place.hpp"
#include "point/point_orbit.hpp"
#include "point/point_trace.hpp"
#include "support/derived_model.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Study derived_study(const std::string& keys = "") {
  return read_study(
      study_of_text(derived_model(), keys + "[[axes]]\nname = 'wn'\nvalues = [1.0, 2.0]\n"
                                            "[integrate]\nmax_step = 0.05\nsettle = 20\n"
                                            "record = 2\n[observe]\nquantities = ['x_rms']\n"),
      "test");
}

std::size_t index_of(const Study& study, const std::string& name) {
  return static_cast<std::size_t>(study.model->find_parameter(name));
}

PointTraces derived_traces(const Study& study, const std::vector<NamedValue>& values) {
  PointTraces found;
  EXPECT_TRUE(add_point_trace(study, find_place(study, values, ""), {}, 0, {}, &found));
  return found;
}

// Between the values of the axis, too.
TEST(DerivedPlace, HasWhatFollowsFromIt) {
  const Study study = derived_study();
  const PointTraces found = derived_traces(study, {{"wn", 1.6}});
  const Trace& trace = found.traces.front();
  EXPECT_THAT(trace.period, DoubleEq(2.5 * std::numbers::pi));
  EXPECT_EQ(trace.setting.parameters[index_of(study, "omega")], 0.8);
  EXPECT_THAT(found.placed, ElementsAre("wn", "omega"));
}

// A number of a place is the number of its motion: the one of a study that gives it.
TEST(DerivedPlace, TakesThePlaceOfTheExpression) {
  const Study study = derived_study(), given = derived_study("[parameters]\nomega = 4.0\n");
  const PointTraces found = derived_traces(study, {{"wn", 1.6}, {"omega", 4.0}});
  const Trace& trace = found.traces.front();
  EXPECT_THAT(trace.period, DoubleEq(0.5 * std::numbers::pi));
  EXPECT_EQ(trace.setting.parameters[index_of(study, "omega")], 4.0);
  const PointTraces same = derived_traces(given, {{"wn", 1.6}});
  EXPECT_EQ(trace.tau, same.traces.front().tau);
  EXPECT_EQ(trace.values, same.traces.front().values);
  // The study itself is what it was.
  EXPECT_THAT(derived_traces(study, {{"wn", 1.6}}).traces.front().period,
              DoubleEq(2.5 * std::numbers::pi));
}

TEST(DerivedPlace, OfAConstantIsGivenByTheStudy) {
  const Study study = derived_study();
  try {
    find_place(study, {{"g", 1.0}}, "--at");
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--at: 'g' is a constant of model 'own'; where it is a "
                                        "plain number, --set parameters.g=VALUE makes it"));
  }
}

OrbitFindings followed(const Study& study, const std::string& along, double from, double to) {
  const OrbitRequest request = {.place = find_place(study, {{"wn", 1.0}}, ""),
                                .range = find_range(*study.model, along, from, to, "along"),
                                .range_origin = "along",
                                .period = {},
                                .steps = 256};
  return find_point_orbit(study, request, {}).value();
}

// The oscillator is linear, so an orbit at the end of a branch is that of a point there.
TEST(DerivedPlace, IsFollowedWithWhatFollows) {
  const Study study = derived_study("[parameters]\nzeta = 0.1\n");
  const OrbitFindings along = followed(study, "wn", 1.0, 1.5);
  EXPECT_THAT(along.forcing_period, DoubleEq(4.0 * std::numbers::pi));
  ASSERT_FALSE(along.branches.empty());
  const BranchOrbit& last = along.branches.back().orbits.back();
  const OrbitRequest there = {.place = find_place(study, {{"wn", last.parameter}}, ""),
                              .range = {},
                              .range_origin = "",
                              .period = {},
                              .steps = 256};
  const Orbit alone = find_point_orbit(study, there, {}).value().orbit;
  EXPECT_GT(last.parameter, 1.3);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_THAT(last.orbit.state[i], DoubleNear(alone.state[i], 1e-7));
  }
  // Along the parameter itself its expression does not hold.
  const OrbitFindings own = followed(study, "omega", 0.5, 0.8);
  EXPECT_THAT(own.forcing_period, DoubleEq(4.0 * std::numbers::pi));
  EXPECT_EQ(own.study.model->find_derived(index_of(study, "omega")), nullptr);
}

}  // namespace
}  // namespace gearsweep::testing
