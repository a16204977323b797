// The jumps of run-up and run-down are the folds of the branch of periodic orbits.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "point/point_orbit.hpp"
#include "result/hysteresis.hpp"
#include "support/run.hpp"

namespace gearsweep {
namespace {

constexpr double kFrom = 0.408, kTo = 0.43;
constexpr std::size_t kCount = 23;
constexpr double kStep = (kTo - kFrom) / (kCount - 1);

std::string study_text(const std::string& initial) {
  return fmt::format(
      "[model]\nname = 'gear5'\npreset = 'coarse'\n[parameters]\ne0 = 0.3\n"
      "[[axes]]\nname = 'omega'\nfrom = {}\nto = {}\ncount = {}\n"
      "{}"
      "[integrate]\nsettle = 200\nrecord = 10\ntolerance = 0\n"
      "[observe]\nquantities = ['dmf_max']\n",
      kFrom, kTo, kCount, initial);
}

ResultMap curve_of(const std::string& policy) {
  const SweepResult result =
      testing::run(study_text(fmt::format("[initial]\npolicy = '{}'\nalong = 'omega'\n", policy)));
  ResultMap map;
  map.axes.emplace_back().values = result.study.axes.front().values;
  map.values = map_of(result, "dmf_max");
  return map;
}

TEST(Jumps, AreTheFoldsOfTheBranch) {
  const std::vector<Hysteresis> found = find_hysteresis(curve_of("forward"), curve_of("backward"));
  ASSERT_EQ(found.size(), 1U);
  ASSERT_TRUE(found.front().jumps_up && found.front().jumps_down);
  const Study whole = read_study(study_text(""), "test");
  const OrbitRequest asked = {.place = find_place(whole, {{"omega", kTo}}, ""),
                              .range = find_range(*whole.model, "omega", kTo, 0.4, "along"),
                              .range_origin = "along",
                              .period = 1,
                              .steps = 512};
  std::vector<double> folds;
  for (const LocatedBifurcation& one :
       bifurcations_of(find_point_orbit(whole, asked, {}).value())) {
    if (one.kind == Bifurcation::fold) folds.push_back(one.parameter);
  }
  ASSERT_EQ(folds.size(), 2U);
  EXPECT_NEAR(found.front().from, folds.front(), 0.5 * kStep);
  EXPECT_NEAR(found.front().to, folds.back(), 0.5 * kStep);
}

ResultMap made(const std::vector<double>& values) {
  ResultMap map;
  map.axes.emplace_back();
  for (std::size_t i = 0; i < values.size(); ++i) {
    map.axes.front().values.push_back(static_cast<double>(i));
  }
  map.values = values;
  return map;
}

TEST(Jumps, AreOnlyWhereOneRunLeapsToTheOther) {
  const ResultMap flat = made({1, 1, 1, 1, 1, 1});
  EXPECT_TRUE(find_hysteresis(flat, flat).empty());
  // They part smoothly and meet smoothly: no jump.
  EXPECT_TRUE(find_hysteresis(flat, made({1, 1.4, 1.8, 1.8, 1.4, 1})).empty());
  // Differences of changing sign, as of chaos.
  EXPECT_TRUE(find_hysteresis(flat, made({1, 2, 0, 2, 0, 1})).empty());
  // A stretch that ends with the axis has one jump.
  const std::vector<Hysteresis> found =
      find_hysteresis(made({1, 1, 1, 1, 3, 3}), made({3, 3, 3, 3, 3, 3}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found.front().jumps_up);
  EXPECT_FALSE(found.front().jumps_down);
  EXPECT_EQ(found.front().to, 3.5);
  EXPECT_EQ(found.front().from, 0.0);
}

}  // namespace
}  // namespace gearsweep
