// Lists of points: what is read from text, and what is refused with its line.
#include "study/point_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "model/error.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal_of_points(const std::string& text) {
  try {
    parse_points(text, "p.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string kList = "[points]\nnames = ['mu', 'v1']\nnumbers = '''\n0.1, -1\n0.05, 2\n'''\n";

TEST(PointTable, HasALineOfNamesAndALineForEachPoint) {
  for (const std::string text :
       {"mu,v1\n0.1,-1\n0.05,2", "mu;v1\n0.1;-1\n0.05;2\n", "mu v1\r\n0.1 -1\r\n0.05 2\r\n",
        "# measured\n\nmu,\tv1 # two\n +0.1, -1e0\n5e-2, 2 # last\n\n"}) {
    const PointTable points = parse_points(text, "p.csv");
    EXPECT_THAT(points.names, ElementsAre("mu", "v1")) << text;
    EXPECT_THAT(points.columns, ElementsAre(ElementsAre(0.1, 0.05), ElementsAre(-1.0, 2.0)));
  }
}

TEST(PointTable, ItsLinesGiveTheSameBits) {
  std::mt19937_64 random(5);
  PointTable points{{"a", "b"}, {{}, {}}};
  while (points.points() < 2000) {
    for (std::vector<double>& column : points.columns) {
      double number = std::nan("");
      while (!std::isfinite(number)) number = std::bit_cast<double>(std::uint64_t{random()});
      column.push_back(number);
    }
  }
  EXPECT_EQ(parse_points(points.names, lines_of(points), "p").columns, points.columns);
}

TEST(PointTable, RefusesWithItsLine) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "p.csv:0: there are no points"},
      {"mu,v1\n", "p.csv:1: there are no points"},
      {"0.1,2\n", "p.csv:1: '0.1' is a number; the first line has the names"},
      {"mu:b\n1\n", "p.csv:1: 'mu:b' is no name of a parameter or an initial state"},
      {"mu,mu\n1,2\n", "p.csv:1: the column 'mu' is there twice"},
      {"mu,v1\n1,2\n1\n", "p.csv:3: 1 number for 2 columns"},
      {"mu\n1,2\n", "p.csv:2: 2 numbers for 1 column"},
      {"mu\n0,5 # a comma\n", "p.csv:2: 2 numbers for 1 column"},
      {"mu\n\nx\n", "p.csv:3: mu = 'x' is not a finite number"},
      {"mu\nnan\n", "p.csv:2: mu = 'nan' is not a finite number"},
      {"mu\n1e999\n", "p.csv:2: mu = '1e999' is not a finite number"},
      {std::string("mu\n\0\n", 5), "p.csv: not a text file"}};
  for (const auto& [text, message] : cases) {
    EXPECT_THAT(refusal_of_points(text), StartsWith(message)) << text;
  }
}

TEST(PointTable, BecomesTheAxisPoint) {
  const Study study = read_study(kList, "s.toml");
  ASSERT_EQ(study.axes.size(), 1U);
  EXPECT_EQ(study.axes[0].name, "point");
  EXPECT_THAT(study.axes[0].values, ElementsAre(1.0, 2.0));
  EXPECT_FALSE(study.axes[0].columns[0].is_state);
  EXPECT_TRUE(study.axes[0].columns[1].is_state);
  EXPECT_THAT(study.axes[0].columns[1].values, ElementsAre(-1.0, 2.0));
  EXPECT_EQ(read_study(study.toml, "again").toml, study.toml);
}

TEST(PointTable, ComesFromAFileBesideTheStudy) {
  const Folder folder;
  folder.write("points.csv", "mu,v1\n0.1,-1\n0.05,2\n");
  const std::string path = (folder / "s.toml").string();
  const Study study = read_study("[points]\nfile = 'points.csv'\n", path);
  EXPECT_EQ(study.toml, read_study(kList, "s.toml").toml);
  EXPECT_EQ(study.points(), 2U);
}

TEST(PointTable, OfAResultIsInItsVariables) {
  const Study study = read_study(kList, "s.toml");
  EXPECT_THAT(study.brief_toml(), ::testing::Not(HasSubstr("numbers")));
  EXPECT_THAT(refusal(study.brief_toml()), HasSubstr("in the result that it is from"));
  const PointTable points{{"mu", "v1"}, {{0.1, 0.05}, {-1.0, 2.0}}};
  EXPECT_EQ(read_study(study.brief_toml(), "r.nc", {}, {}, points).toml, study.toml);
}

TEST(PointTable, MayStandBesideOneAxis) {
  const std::string axis = "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7, 0.9]\n";
  EXPECT_EQ(read_study(axis + kList, "s.toml").points(), 6U);
  EXPECT_THAT(refusal(axis + "[[axes]]\nname = 'b'\nvalues = [1]\n" + kList),
              HasSubstr("a list takes the place of one axis"));
  EXPECT_THAT(refusal("[[axes]]\nname = 'mu'\nvalues = [0.1]\n" + kList),
              HasSubstr("the axes 'mu' and 'point' both give mu"));
}

TEST(PointTable, IsRefusedWhereTheModelHasNoSuchValues) {
  EXPECT_THAT(refusal("[points]\nnames = ['nu']\nnumbers = '1'\n"),
              HasSubstr("column 'nu' is neither a parameter nor a state of model 'gear5'; did you "
                        "mean 'mu'?"));
  EXPECT_THAT(refusal("[points]\nnames = ['mu']\nnumbers = '''\n0.1\n-3\n'''\n"),
              HasSubstr("point 2: mu = -3 is out of range"));
  EXPECT_THAT(refusal("[points]\nnames = ['mu']\nnumbers = '''\n0.1\n1 2\n'''\n"),
              HasSubstr("2 numbers for 1 column"));
  EXPECT_THAT(refusal("[points]\n"), HasSubstr("[points] needs a file"));
  EXPECT_THAT(refusal("points = 3\n"), HasSubstr("points must be a table: [points]"));
  EXPECT_THAT(refusal("[points]\nnumbers = '1'\n"), HasSubstr("numbers need names"));
  EXPECT_THAT(refusal("[points]\nfile = 'none.csv'\n"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal(kList + "[initial]\npolicy = 'forward'\n"),
              HasSubstr("'point', which has initial states"));
}

}  // namespace
}  // namespace gearsweep::testing
