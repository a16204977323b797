// Derived parameters in a result file: coordinates, along what changes them.
#include "result/detail/derived_coordinates.hpp"

#include <gmock/gmock.h>

#include "result/example_result.hpp"
#include "result/export.hpp"
#include "result/random_result.hpp"
#include "result/result_size.hpp"
#include "support/derived_model.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::derived_model;
using gearsweep::testing::kProvenance;
using gearsweep::testing::random_result;
using gearsweep::testing::study_of_text;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kZeta = "[[axes]]\nname = 'zeta'\nvalues = [0.1, 0.3]\n";
const std::string kWn = "[[axes]]\nname = 'wn'\nvalues = [1.0, 2.0, 4.0]\n";
const std::string kObserve = "[observe]\nquantities = ['x_rms']\n";

class DerivedCoordinatesTest : public gearsweep::testing::IoTest {
 protected:
  static Study study(const std::string& keys) {
    return read_study(study_of_text(derived_model(), keys + kObserve), "s.toml");
  }
  std::string written(const Study& study) { return write(random_result(study, 2, &random_)); }

  std::mt19937_64 random_{1};
};

TEST_F(DerivedCoordinatesTest, AreColumnsOfTheAxisThatChangesThem) {
  for (const bool is_x : {true, false}) {
    const Study study = this->study(is_x ? kWn + kZeta : kZeta + kWn);
    const std::string path = written(study);
    const ResultFile file(path);
    const std::size_t axis = is_x ? 0 : 1;
    ASSERT_EQ(file.axes()[axis].columns.size(), 1U);
    const ResultAxis& omega = file.axes()[axis].columns[0];
    EXPECT_EQ(omega.name, "omega");
    EXPECT_EQ(omega.unit, "1/s");
    EXPECT_EQ(omega.meaning, "frequency");
    EXPECT_THAT(omega.values, ElementsAre(0.5, 1.0, 2.0));
    EXPECT_THAT(file.axes()[1 - axis].columns, IsEmpty());
    EXPECT_THAT(file.quantities(), ElementsAre("status", "x_rms"));
    EXPECT_THAT(file.settings_text(), HasSubstr("omega = '0.5*wn'\n"));
    // The study of the file is the same one.
    const Study again = read_study(read_study_text(path), path);
    EXPECT_EQ(again.toml, study.toml);
    EXPECT_EQ(values_of(derived_coordinates(again)[0], again), omega.values);
    export_maps(path, {"x_rms"}, in_folder("out.csv"));
    EXPECT_THAT(content(in_folder("out.csv")),
                StartsWith(is_x ? "wn [1],omega [1/s],zeta" : "zeta [1],wn"));
  }
}

TEST_F(DerivedCoordinatesTest, AreMapsWhereBothAxesChangeThem) {
  const Study study = this->study("[parameters]\nomega = 'wn*zeta'\n" + kWn + kZeta);
  const ResultFile file(written(study));
  EXPECT_THAT(file.quantities(), Contains("omega"));
  const ResultMap omega = file.read("omega");
  ASSERT_EQ(omega.values.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(omega.values[i], study.axes[0].values[i % 3] * study.axes[1].values[i / 3]);
  }
}

// What only tolerances change has no value of a point, and what nothing changes is in the settings.
TEST_F(DerivedCoordinatesTest, AreOfAxesAlone) {
  EXPECT_THAT(derived_coordinates(study(kZeta)), IsEmpty());
  EXPECT_THAT(derived_coordinates(study("[parameters]\nomega = 2\n" + kWn)), IsEmpty());
  const Study drawn = study(
      kZeta + "[uncertain]\nsamples = 2\nwn = {distribution = 'uniform', from = 1, to = 3}\n");
  EXPECT_THAT(derived_coordinates(drawn), IsEmpty());
}

// A list of points is read back from the columns that were given, not from those that follow.
TEST_F(DerivedCoordinatesTest, AreNoColumnsOfAList) {
  const Study study =
      this->study("[points]\nnames = ['wn', 'zeta']\nnumbers = '''\n1 0.1\n4 0.2\n'''\n");
  const std::string path = written(study);
  EXPECT_THAT(read_point_table(path).names, ElementsAre("wn", "zeta"));
  EXPECT_THAT(ResultFile(path).axes()[0].columns.back().values, ElementsAre(0.5, 2.0));
}

TEST_F(DerivedCoordinatesTest, AreCountedInTheSizeOfAFile) {
  const std::string grid = kWn + "[[axes]]\nname = 'zeta'\nfrom = 0.1\nto = 0.2\ncount = 20000\n";
  const double without =
      size_of_result(study("[parameters]\nomega = 2\n" + grid), kProvenance).file;
  const double map =
      size_of_result(study("[parameters]\nomega = 'wn*zeta'\n" + grid), kProvenance).file;
  EXPECT_GT(map, without + 8.0 * 60000.0);
}

}  // namespace
}  // namespace gearsweep
