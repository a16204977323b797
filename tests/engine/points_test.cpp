// Points of a list are computed as the points of a map are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "study/builtin_models.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

std::string as_text(const PointTable& points) {
  std::string names;
  for (const std::string& name : points.names) names += fmt::format("'{}', ", name);
  return fmt::format("[points]\nnames = [{}]\nnumbers = '''\n{}'''\n", names, lines_of(points));
}

// The points of a map over two axes, the first one fastest.
PointTable listed(const std::vector<Axis>& axes) {
  PointTable points{{axes[0].name, axes[1].name}, {{}, {}}};
  for (const double y : axes[1].values) {
    for (const double x : axes[0].values) {
      points.columns[0].push_back(x);
      points.columns[1].push_back(y);
    }
  }
  return points;
}

void expect_same_maps(const SweepResult& list, const SweepResult& map) {
  EXPECT_EQ(list.status, map.status);
  ASSERT_EQ(list.values.size(), map.values.size());
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    EXPECT_EQ(different_bits(list.values[i], map.values[i]), 0U)
        << map.study.selection.quantities[i].name;
  }
}

const std::string kShort = "[integrate]\nsettle = 60\nrecord = 20\n";

TEST(Points, OfAMapAsAListHaveTheBitsOfTheMap) {
  const std::string rest = "[model]\npreset = 'coarse'\n" + kShort + kObserveMotionOfGear5;
  const SweepResult map =
      run("[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 7\n"
          "[[axes]]\nname = 'b'\nfrom = 0.4\nto = 1.2\ncount = 5\n" +
          rest);
  expect_same_maps(run(as_text(listed(map.study.axes)) + rest), map);
}

TEST(Points, StartWhereTheirInitialStatesSay) {
  const std::string rest = "[model]\npreset = 'coarse'\n[parameters]\nomega = 0.55\n" + kShort +
                           "[observe]\nquantities = ['x1_rms', 'attractor']\n";
  const SweepResult map =
      run("[[axes]]\nname = 'x1'\nfrom = -2\nto = 2.5\ncount = 6\n"
          "[[axes]]\nname = 'v1'\nfrom = -1.5\nto = 1.5\ncount = 4\n" +
          rest);
  expect_same_maps(run(as_text(listed(map.study.axes)) + rest), map);
}

// Rows that share their parameters are one site, in whatever order they stand.
TEST(Points, ShareTheAttractorsOfTheirParameters) {
  PointTable points{{"omega", "x1"}, {{}, {}}};
  const std::string rest =
      "[model]\npreset = 'coarse'\n" + kShort + "[observe]\nquantities = ['attractor', 'x1_rms']\n";
  for (int i = 0; i < 6; ++i) {
    points.columns[0].push_back(i % 2 == 0 ? 0.55 : 1.4);
    points.columns[1].push_back(1.3);
  }
  const std::vector<double> attractor = map_of(run(as_text(points) + rest), "attractor");
  EXPECT_NE(attractor[0], attractor[1]);
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(attractor[i], attractor[i - 2]);
}

TEST(Points, MayGoOnFromTheirNeighbours) {
  PointTable points{{"omega"}, {{}}};
  const std::string rest =
      "[model]\npreset = 'coarse'\n[initial]\npolicy = 'backward'\n" + kShort + kObserveGear5;
  const SweepResult map = run("[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 9\n" + rest);
  points.columns[0] = map.study.axes[0].values;
  expect_same_maps(run(as_text(points) + rest), map);
}

TEST(Points, MayEachHaveAllValuesOfAnAxis) {
  const std::string rest =
      "[model]\npreset = 'coarse'\n" + kShort + "[observe]\nquantities = ['x1_rms', 'dmf_max']\n";
  const std::string axis = "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 5\n";
  const SweepResult both = run(axis + as_text({{"b", "mu"}, {{1.0, 0.5}, {0.0, 0.1}}}) + rest);
  const SweepResult second = run(axis + rest, {"parameters.b=0.5", "parameters.mu=0.1"});
  ASSERT_EQ(both.status.size(), 10U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(same_bits(map_of(both, "dmf_max")[5 + i], map_of(second, "dmf_max")[i])) << i;
  }
}

// Three random parameters of a model, near their presets, and the first state.
PointTable random_points(const Model& model, std::size_t count) {
  std::mt19937_64 random(std::hash<std::string>{}(model.name));
  std::uniform_real_distribution<double> share(0.8, 1.2);
  const std::vector<double> usual = model.default_setting().parameters;
  std::vector<std::size_t> chosen(model.parameters.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  std::erase_if(chosen, [&](std::size_t i) { return usual[i] == 0.0; });
  std::shuffle(chosen.begin(), chosen.end(), random);
  chosen.resize(std::min<std::size_t>(3, chosen.size()));
  PointTable points;
  for (const std::size_t i : chosen) {
    const ParameterInfo& info = model.parameters[i];
    std::vector<double> column(count);
    for (double& value : column) value = std::clamp(usual[i] * share(random), info.min, info.max);
    points.names.push_back(info.name);
    points.columns.push_back(std::move(column));
  }
  points.names.push_back(model.states.front().name);
  points.columns.emplace_back();
  while (points.columns.back().size() < count) points.columns.back().push_back(share(random));
  return points;
}

// A study of the one point.
std::string alone(const PointTable& points, std::size_t point) {
  std::string text = "[parameters]\n";
  for (std::size_t i = 0; i + 1 < points.names.size(); ++i) {
    text += fmt::format("{} = {}\n", points.names[i], points.columns[i][point]);
  }
  return text + fmt::format("[[axes]]\nname = '{}'\nvalues = [{}]\n", points.names.back(),
                            points.columns.back()[point]);
}

// What is folded into the kernel's tables differs, and so does rounding.
TEST(Points, OfAnyModelAreThoseOfStudiesOfOnePoint) {
  for (const std::string name : {"gear5", "gear1", "duffing", "pendulum", "vanderpol"}) {
    const Model& model = *find_model(name);
    const std::string quantity = model.states.front().name + "_rms";
    const std::string rest = "[model]\nname = '" + name +
                             "'\n[integrate]\nsettle = 2\nrecord = 2\nstop = 'never'\n" +
                             observe_all_of(model);
    const PointTable points = random_points(model, 5);
    const std::vector<double> list = map_of(run(as_text(points) + rest), quantity);
    for (std::size_t point = 0; point < list.size(); ++point) {
      const double single = map_of(run(alone(points, point) + rest), quantity)[0];
      EXPECT_NEAR(list[point], single, 1e-8 * std::abs(single)) << name << ", point " << point;
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
