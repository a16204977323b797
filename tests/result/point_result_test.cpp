// The result of a list of points says where each point lies, and runs again without the list's
// file.
#include <gmock/gmock.h>

#include "result/example_result.hpp"
#include "result/export.hpp"
#include "result/python.hpp"
#include "result/study_source.hpp"
#include "study/study.hpp"
#include "support/study_text.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::run_python;
using gearsweep::testing::Spoken;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kPointList =
    "[points]\nnames = ['mu', 'v1']\nnumbers = '''\n0.1, -1\n0.05, 2\n0.1, 0\n'''\n";

class PointResultTest : public gearsweep::testing::IoTest {
 protected:
  static SweepResult result_of(const std::string& toml) {
    const Study study = read_study(toml, "s.toml");
    SweepResult result = example_result(study.points(), 0);
    result.study.axes = study.axes;
    result.study.toml = study.toml;
    result.study.model = study.model;
    result.study.own_model = study.own_model;
    return result;
  }
};

TEST_F(PointResultTest, HasTheColumnsBesideItsMaps) {
  const ResultFile file(write(result_of(kPointList)));
  EXPECT_THAT(file.quantities(), ElementsAre("status", "x1_rms", "contact_class", "poincare"));
  ASSERT_EQ(file.axes().size(), 1U);
  EXPECT_EQ(file.axes()[0].name, "point");
  EXPECT_THAT(file.axes()[0].values, ElementsAre(1, 2, 3));
  ASSERT_EQ(file.axes()[0].columns.size(), 2U);
  EXPECT_EQ(file.axes()[0].columns[0].name, "mu");
  EXPECT_THAT(file.axes()[0].columns[1].values, ElementsAre(-1, 2, 0));
  EXPECT_EQ(file.axes()[0].columns[1].unit, "b_n varpi");
}

TEST_F(PointResultTest, HoldsTheStudyWithItsNumbersOnce) {
  const SweepResult result = result_of(kPointList);
  const std::string path = write(result);
  EXPECT_THAT(read_study_text(path), ::testing::Not(HasSubstr("0.05")));
  EXPECT_EQ(read_result_study(path).toml, result.study.toml);
}

TEST_F(PointResultTest, IsATableWithTheColumns) {
  const std::string out = in_folder("out.csv");
  export_maps(write(result_of(kPointList)), {"x1_rms"}, out);
  EXPECT_EQ(content(out),
            "point [1],mu [1],v1 [b_n varpi],x1_rms [b_n]\n"
            "1,0.1,-1,0.1\n2,0.05,2,1.1\n3,0.1,0,2.1\n");
}

TEST_F(PointResultTest, GivesXarrayTheColumnsAsCoordinates) {
  const std::string path = write(result_of(kPointList));
  const Spoken spoken = run_python(
      "import xarray, sys\nmaps = xarray.open_dataset(sys.argv[1])\n"
      "print(sorted(maps.x1_rms.coords), float(maps.x1_rms[maps.mu.argmin()]))\n",
      path);
  EXPECT_EQ(spoken.text, "['mu', 'point', 'v1'] 1.1\n");
}

TEST_F(PointResultTest, RunsAgainWhereAColumnHasTheNameOfAMap) {
  SweepResult result =
      result_of(gearsweep::testing::kPushed +
                std::string("[points]\nnames = ['period', 'x']\nnumbers = '5, 1'\n"));
  result.study.selection = select_quantities(*result.study.model, {"x_rms", "period"}, {});
  result.samples.clear();
  const std::string path = write(result);
  EXPECT_EQ(ResultFile(path).axes()[0].columns[0].name, "parameter_period");
  EXPECT_EQ(read_result_study(path).toml, result.study.toml);
}

}  // namespace
}  // namespace gearsweep
