// gearsweep orders and report as a user types them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/names.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const char* const kOrderStudy =
    "[model]\nname = 'gear1'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.8, 1.0]\n"
    "[[axes]]\nname = 'Fm'\nvalues = [0.1, 0.2]\n[integrate]\nsettle = 20\nrecord = 4\n"
    "stop = 'never'\n[observe]\nquantities = ['x_rms']\n";

TEST(OrdersCommand, WritesATableWithARowForEachOrderAndSpeed) {
  const Folder folder;
  folder.write("study.toml", kOrderStudy);
  const Outcome outcome = gearsweep(
      folder, "orders study.toml -q x --record 4 --orders 2 --samples-per-period 16 -o x.csv");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("x at 3 values of omega, orders 0 to 2 by 1/4"));
  const std::string table = read_all(folder / "x.csv");
  EXPECT_THAT(table, StartsWith("omega [varpi],order,frequency [varpi],amplitude [b_n],"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3 * 9);
  EXPECT_THAT(table, HasSubstr("\n0.8,0.5,0.4,"));
}

// Fixed columns, by the description of dataset 58 (Structural Dynamics Research Laboratory,
// University of Cincinnati): records 1 to 5 are texts of 80 letters, 6 to 11 are what is said of
// the numbers.
TEST(OrdersCommand, WritesAUniversalFileWithADatasetForEachSpeed) {
  const Folder folder;
  folder.write("study.toml", kOrderStudy);
  const std::string words = "orders study.toml -q x --record 4 --orders 2 --samples-per-period 16";
  ASSERT_EQ(gearsweep(folder, words + " -o x.uff").status, 0);
  ASSERT_EQ(gearsweep(folder, words + " -o x.csv").status, 0);
  const std::vector<std::string> lines = split(read_all(folder / "x.uff"), '\n');
  const std::vector<std::string> rows = split(read_all(folder / "x.csv"), '\n');
  constexpr std::size_t kLines = 17;  // of 9 numbers, 4 in a line
  ASSERT_EQ(lines.size(), 3 * kLines + 1);
  for (std::size_t set = 0; set < 3; ++set) {
    const auto line = [&](std::size_t i) { return lines[set * kLines + i]; };
    EXPECT_EQ(line(0), "    -1");
    EXPECT_EQ(line(1), "    58");
    for (std::size_t i = 2; i < 7; ++i) EXPECT_EQ(line(i).size(), 80U);
    EXPECT_EQ(line(7).substr(0, 5), "   12") << "a spectrum";
    EXPECT_EQ(line(8).substr(0, 30), "         4         9         1") << "even, double precision";
    EXPECT_EQ(std::stod(line(8).substr(43, 13)), 0.25) << "the step of the order";
    EXPECT_NEAR(std::stod(line(8).substr(56, 13)), 0.6 + 0.2 * static_cast<double>(set), 1e-5);
    EXPECT_EQ(line(9).substr(0, 10), "        20") << "over the order";
    EXPECT_THAT(line(10), HasSubstr("x                    b_n"));
    EXPECT_EQ(line(kLines - 1), "    -1");
    for (std::size_t i = 0; i < 9; ++i) {
      const double amplitude = std::stod(line(13 + i / 4).substr(20 * (i % 4), 20));
      const std::vector<std::string> cells = split(rows[1 + 9 * set + i], ',');
      EXPECT_NEAR(amplitude, std::stod(cells[3]), 1e-11 * std::stod(cells[3])) << set << " " << i;
    }
  }
}

TEST(OrdersCommand, AndReportAreOfAForcing) {
  const Folder folder;
  folder.write("free.toml",
               "[model]\nname = 'clock'\n[[axes]]\nname = 'friction'\nvalues = [0.05]\n");
  for (const char* words : {"orders free.toml -o out.nc", "report free.toml -o out.html"}) {
    const Outcome outcome = gearsweep(folder, words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("nothing drives model 'clock'"));
  }
}

struct OrdersMistake {
  std::string arguments, message;
};

class OrdersRefusal : public ::testing::TestWithParam<OrdersMistake> {};

TEST_P(OrdersRefusal, SaysWhatIsWrongAndLeavesNoFile) {
  const Folder folder;
  folder.write("study.toml", kOrderStudy);
  const Outcome outcome = gearsweep(folder, GetParam().arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_EQ(folder.files(), std::set<std::string>{"study.toml"});
}

INSTANTIATE_TEST_SUITE_P(
    Cases, OrdersRefusal,
    ::testing::Values(
        OrdersMistake{"orders study.toml", "give -o OUT.nc, -o OUT.csv or --plot OUT.png"},
        OrdersMistake{"orders study.toml -o o.txt", "must end in .nc, .csv or .uff"},
        OrdersMistake{"orders study.toml -o o.nc --over b", "it has omega and Fm"},
        OrdersMistake{"orders study.toml -o o.nc -q dmg", "did you mean 'dmf'?"},
        OrdersMistake{"orders study.toml -o o.nc --at omega=0.7", "the map goes over 'omega'"},
        OrdersMistake{"orders study.toml -o o.csv --units SI", "no [gear] table"},
        OrdersMistake{"orders study.toml --plot o.gif", "must end in .png"},
        OrdersMistake{"orders study.toml -o o.nc --orders 300", "give 1200 samples per period"},
        OrdersMistake{"report study.toml -o r.txt", ".html or .pdf"},
        OrdersMistake{"report study.toml -o r.html --set axes.omega.name=b", "name = \"omega\""},
        OrdersMistake{"report study.toml -o /nowhere/r.html", "/nowhere/r.html"}));

}  // namespace
}  // namespace gearsweep::testing
