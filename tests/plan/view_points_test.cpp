// The points of a view of a map.
#include "plan/view_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "plan/plan.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kMap =
    "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.9\ncount = 12\n"
    "[[axes]]\nname = 'b'\nfrom = 0.1\nto = 1.0\ncount = 5\nscale = 'log'\n";

std::shared_ptr<const Study> study_of(const std::string& text) {
  return std::make_shared<const Study>(read_study(text, "test.toml"));
}

std::array<double, 2> values_at(const ViewPoints& points, const Study& study, std::size_t point) {
  ModelSetting setting = study.setting;
  points.set(point, &setting);
  return {setting.parameters[study.axes[0].index], setting.parameters[study.axes[1].index]};
}

TEST(ViewPoints, GoThroughARectangleRowByRow) {
  const auto study = study_of(kMap);
  const ViewPoints points(study, {2, {{{1, 3}, {0, 2}}}});
  EXPECT_EQ(points.size(), 6U);
  EXPECT_THAT(points.differing(), ElementsAre(study->axes[0].index, study->axes[1].index));
  EXPECT_THAT(values_at(points, *study, 0), ElementsAre(0.3 + (1.9 - 0.3) * 0.25, 0.1));
  EXPECT_THAT(values_at(points, *study, 2)[0], 0.3 + (1.9 - 0.3) * 0.75);
  EXPECT_THAT(values_at(points, *study, 3)[1], 0.1 * std::pow(10.0, 0.25));
}

// However deep: a deeper view has the points of one that is less deep, with the same bits.
TEST(ViewPoints, OfAFinerViewAreThreeQuartersNewAndOneQuarterTheSame) {
  const auto study = study_of(kMap);
  for (const std::size_t depth : {1U, 7U, 30U, 51U}) {
    const std::uint64_t first = (std::uint64_t{1} << depth) / 3;
    const ViewPoints coarse(study, {depth, {{{first, 2}, {first, 2}}}});
    const View deeper = {depth + 1, {{{2 * first, 4}, {2 * first, 4}}}};
    const ViewPoints all(study, deeper), finer(study, deeper, true);
    ASSERT_EQ(finer.size(), 12U);
    std::set<std::array<double, 2>> found, wanted;
    for (std::size_t i = 0; i < all.size(); ++i) wanted.insert(values_at(all, *study, i));
    for (std::size_t i = 0; i < coarse.size(); ++i) found.insert(values_at(coarse, *study, i));
    EXPECT_EQ(found.size(), 4U);
    for (std::size_t i = 0; i < finer.size(); ++i) {
      EXPECT_TRUE(found.insert(values_at(finer, *study, i)).second);
      EXPECT_EQ(finer.place_of(finer.cell_of(i)), values_at(finer, *study, i));
    }
    EXPECT_EQ(found, wanted);
  }
}

TEST(ViewPoints, EndAtTheEndsOfTheAxes) {
  const auto study = study_of(kMap);
  const ViewPoints points(study, {3, {{{8, 1}, {8, 1}}}});
  EXPECT_THAT(values_at(points, *study, 0), ElementsAre(1.9, 1.0));
  EXPECT_THROW(ViewPoints(study, {3, {{{8, 2}, {8, 1}}}}), InputError);
  EXPECT_THROW(ViewPoints(study, {3, {{{0, 3}, {0, 2}}}}, true), InputError);
  EXPECT_THROW(ViewPoints(study, {53, {{{0, 1}, {0, 1}}}}), InputError);
}

TEST(ViewPoints, WantAGridOfPointsOnTheirOwn) {
  const auto refusal = [](const std::string& more) -> std::string {
    try {
      ViewPoints(study_of(kMap + more), {1, {{{0, 1}, {0, 1}}}});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(""), "accepted");
  EXPECT_THAT(refusal("[initial]\npolicy = 'forward'\n"), HasSubstr("start on their own"));
}

// As they would be in a plan of the study's own points.
TEST(ViewPoints, AreGroupedByTheirPhaseGrids) {
  const auto study = study_of(kMap);
  const auto points = std::make_shared<const ViewPoints>(study, View{3, {{{0, 8}, {0, 8}}}});
  const Plan plan(study, points, 16);
  std::set<std::size_t> all;
  for (const Tile* tile : tiles_of(plan)) {
    std::size_t group = 0;
    for (std::size_t i = 0; i < tile->points.size(); ++i) {
      if (group + 1 < tile->grid_starts.size() && tile->grid_starts[group + 1] == i) ++group;
      EXPECT_EQ(plan.grid_key(tile->points[i]),
                plan.grid_key(tile->points[tile->grid_starts[group]]));
      all.insert(tile->points[i]);
    }
  }
  EXPECT_EQ(all.size(), 64U);
}

}  // namespace
}  // namespace gearsweep::testing
