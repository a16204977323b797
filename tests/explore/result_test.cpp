// Numbers that come from a result file, and those that go into one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "explore/explored.hpp"
#include "explore/explorer.hpp"
#include "model/error.hpp"
#include "result/result_file.hpp"
#include "result/study_source.hpp"
#include "support/bits.hpp"
#include "support/folder.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

TEST(ResultData, IsThatOfTheFileWhereTheSceneIsItsOwn) {
  const Folder folder;
  const std::string path = folder / "map.nc";
  const SweepResult result = run(read_study(kExplored, "test.toml"));
  write_result(result, path, {});
  const ExploredStudy base = explored();
  Explorer explorer(base, {.source = "test",
                           .is_model = false,
                           .devices = {},
                           .data = read_result_data(path, base.study)});
  const auto own = explorer.make_scene({}),
             other = explorer.make_scene({{{"damping", 0.3}}, "", ""});
  EXPECT_EQ(explorer.data(*other), nullptr);
  const ResultData* data = explorer.data(*own);
  ASSERT_NE(data, nullptr);
  EXPECT_EQ(data->values[0], result.study.axes[0].values);
  EXPECT_EQ(data->values[1], result.study.axes[1].values);
  const std::size_t points = result.status.size();
  ASSERT_EQ(data->numbers.size(), 4 * points);
  for (std::size_t i = 0; i < points; ++i) {
    EXPECT_TRUE(same_bits(data->numbers[points + i], result.values[0][i]));
  }
}

// It is a result like those of 'gearsweep run': its own study, run again, gives its numbers.
TEST(ViewResult, HasTheNumbersOfItsOwnStudy) {
  const Folder folder;
  const std::string path = folder / "view.nc";
  Explorer explorer(explored(), {.source = "test", .is_model = false, .devices = {}});
  const auto scene = explorer.make_scene({});
  const ShareRange view = {{0.45, 0.3}, {0.55, 0.36}};
  std::ofstream(path, std::ios::binary) << explorer.result_file(*scene, view, 2, false);
  const ResultFile file(path);
  ASSERT_EQ(file.axes().size(), 2U);
  EXPECT_GE(file.axes()[0].values.front(), scene->value_at(0, 0.45));
  EXPECT_LE(file.axes()[0].values.back(), scene->value_at(0, 0.55));
  EXPECT_EQ(file.axes()[0].values.size(), 13U);  // of 128 cells
  EXPECT_EQ(file.axes()[1].values.size(), 8U);
  const SweepResult again = run(read_result_study(path));
  const std::vector<double> x_max = file.read("x_max").values;
  ASSERT_EQ(x_max.size(), again.values[0].size());
  for (std::size_t i = 0; i < x_max.size(); ++i) {
    EXPECT_TRUE(same_bits(x_max[i], again.values[0][i])) << i;
  }
  EXPECT_THROW(explorer.result_file(*scene, {{0.5, 0.5}, {0.5 + 1e-9, 0.6}}, 2, false), InputError);
  EXPECT_THROW(explorer.result_file(*scene, {}, 30, false), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
