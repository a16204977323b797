// The longer windows of undecided points: how long they are, which points go on, and what is taken
// over from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sweep_types.h"
#include "tile/detail/longer_window.hpp"
#include "tile/subset.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kUndecided = 0.0, kPeriodic = 1.0, kChaotic = 3.0;

// Outputs: x1_rms, then motion_class.
Study study_of_four() {
  return read_study(
      "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.6, 1.5, 1.6]\n[observe]\n"
      "quantities = ['x1_rms', 'motion_class', 'poincare']\n[integrate]\n"
      "settle = 50\nrecord = 2\nextend = 8\nwarm_up = 7\n",
      "test");
}

// A result of the four points, with these classes. x1_rms is its first observer's second output.
TileResult result_of(const Study& study, const std::vector<double>& classes) {
  const std::size_t points = classes.size();
  TileResult result;
  result.status.assign(points, STATUS_ok);
  for (std::size_t output = 0; output < study.selection.output_count(); ++output) {
    for (std::size_t i = 0; i < points; ++i) {
      const bool is_class = output == *study.selection.motion;
      result.outputs.push_back(is_class ? classes[i] : 10.0 * static_cast<double>(output));
    }
  }
  result.samples.assign(points * 2, 0.25);
  for (std::size_t i = 0; i < points * study.model->states.size(); ++i) {
    result.final_states.push_back(static_cast<double>(i));
  }
  return result;
}

TEST(Windows, EachFollowsTheOneBeforeItAndIsTwiceAsLong) {
  const std::vector<Window> windows = windows_of(study_of_four());
  ASSERT_EQ(windows.size(), 4U);
  std::size_t record = 2;
  std::size_t end = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    EXPECT_EQ(windows[i].before, end);
    EXPECT_EQ(windows[i].settle, i == 0 ? 50U : 7U);
    EXPECT_EQ(windows[i].record, record);
    EXPECT_EQ(windows[i].samples, i == 0 ? 2U : 0U);
    EXPECT_EQ(windows[i].is_last, i == 3);
    end += windows[i].settle + windows[i].record;
    record *= 2;
  }
}

TEST(Windows, ThereIsOnlyOneWhenNobodyAsksForKindsOfMotion) {
  Study study = study_of_four();
  study.selection.motion.reset();
  const std::vector<Window> windows = windows_of(study);
  ASSERT_EQ(windows.size(), 1U);
  EXPECT_TRUE(windows[0].is_last);
}

TEST(Extension, TakesTheUndecidedPointsWithTheirStatesAndPhaseGrids) {
  const Study study = study_of_four();
  const Plan plan(study, 16);
  const Tile& tile = plan.stages().at(0).tiles.at(0);
  ASSERT_EQ(tile.points.size(), 4U);
  TileResult result = result_of(study, {kUndecided, kPeriodic, kUndecided, kUndecided});
  result.status[3] = STATUS_diverged;
  const std::vector<std::size_t> positions = undecided_positions(study, result);
  EXPECT_EQ(positions, (std::vector<std::size_t>{0, 2}));

  const Window window = windows_of(study)[1];
  const Tile subset = subset_of(plan, tile, positions, window.settle + window.record);
  EXPECT_THAT(std::vector<std::size_t>(subset.points.begin(), subset.points.end()),
              ::testing::ElementsAre(tile.points[0], tile.points[2]));
  // Each phase grid of the tile that is still there begins where its first point stands.
  EXPECT_EQ(subset.grid_starts, (std::vector<std::size_t>{0, 1}));
  const auto steps =
      static_cast<double>(plan.steps_of(subset.points[0]) + plan.steps_of(subset.points[1]));
  EXPECT_EQ(subset.work, steps * (7 + 4));

  const std::vector<double> ends = end_states(result, positions);
  ASSERT_EQ(ends.size(), 20U);
  EXPECT_EQ(ends[0], 0.0);
  EXPECT_EQ(ends[10], 20.0);
}

TEST(Extension, ReplacesVerdictsAndKeepsWhatWasMeasured) {
  const Study study = study_of_four();
  TileResult whole = result_of(study, {kUndecided, kPeriodic, kUndecided, kPeriodic});
  const TileResult before = whole;
  TileResult subset = result_of(study, {kChaotic, kPeriodic});
  for (double& output : subset.outputs) output += 100.0;
  const std::size_t motion = *study.selection.motion;
  subset.outputs[motion * 2] = kChaotic;
  subset.outputs[motion * 2 + 1] = kPeriodic;
  adopt_verdicts(study, {0, 2}, subset, &whole);
  for (std::size_t output = 0; output < study.selection.output_count(); ++output) {
    for (std::size_t point = 0; point < 4; ++point) {
      const std::size_t at = output * 4 + point;
      const bool replaced = output == motion && point % 2 == 0;
      const double verdict = point == 0 ? kChaotic : kPeriodic;
      EXPECT_EQ(whole.outputs[at], replaced ? verdict : before.outputs[at]) << at;
    }
  }
  EXPECT_EQ(whole.samples, before.samples);
  EXPECT_EQ(whole.final_states, before.final_states);
}

TEST(Extension, APointThatDivergesInALongerWindowHasNoValueAnywhere) {
  const Study study = study_of_four();
  TileResult whole = result_of(study, {kUndecided, kPeriodic, kUndecided, kPeriodic});
  TileResult subset = result_of(study, {kChaotic, kPeriodic});
  subset.status[1] = STATUS_diverged;
  adopt_verdicts(study, {0, 2}, subset, &whole);
  EXPECT_EQ(whole.status[2], STATUS_diverged);
  for (std::size_t point = 0; point < 4; ++point) {
    for (std::size_t output = 0; output < study.selection.output_count(); ++output) {
      EXPECT_EQ(std::isnan(whole.outputs[output * 4 + point]), point == 2);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(std::isnan(whole.samples[point * 2 + i]), point == 2);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
