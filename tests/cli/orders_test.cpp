// gearsweep orders and report as a user types them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

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
        OrdersMistake{"orders study.toml -o o.txt", "must end in .nc or .csv"},
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
