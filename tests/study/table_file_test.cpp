// Files of measured curves: what is read, and what is refused with its line.
#include "study/table_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <locale>
#include <numbers>
#include <random>

#include "model/error.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kTurnOfTable = 2.0 * std::numbers::pi;

std::vector<TablePoint> points(const std::string& text) { return parse_table(text, "m.csv"); }

template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string refusal_of_table(const std::string& text) {
  return refusal_of([&] { points(text); });
}

TEST(TableFile, HasColumnsOfSeveralKinds) {
  const auto expected = ElementsAre(TablePoint{0.0, 1.5}, TablePoint{2.0, -2.0});
  for (const std::string text :
       {"0,1.5\n2,-2", "0;1.5\n2;-2\n", "0 1.5\n2 -2\n", "0\t1.5\r\n2\t-2\r\n",
        "# measured\n\nphase, stiffness # N/m\n  0 , +1.5 # first\n 2.0,-2e0,\n",
        "\xEF\xBB\xBFPhase;k\n0;1.5\n2;-2\n", "+0 15e-1\n2 -2 \n\n"}) {
    EXPECT_THAT(points(text), expected) << text;
  }
}

TEST(TableFile, HasPhasesInSeveralUnits) {
  EXPECT_THAT(points("share,k\n0,1\n0.25,2\n"),
              ElementsAre(TablePoint{0.0, 1.0}, TablePoint{0.25 * kTurnOfTable, 2.0}));
  const std::vector<TablePoint> degrees = points("degree k\n90 1\n180 2\n");
  EXPECT_DOUBLE_EQ(degrees[0].phase, 0.25 * kTurnOfTable);
  EXPECT_DOUBLE_EQ(degrees[1].phase, 0.5 * kTurnOfTable);
}

// A last point that repeats the first one is left out, also where a decimal is rounded.
TEST(TableFile, EndsWhereItBegins) {
  const auto open = ElementsAre(TablePoint{0.0, 1.0}, TablePoint{2.0, 5.0});
  EXPECT_THAT(points("0 1\n2 5\n6.2832 1\n"), open);
  EXPECT_THAT(points("0 1\n2 5\n6.283185307179586 1.000000001\n"), open);
  EXPECT_THAT(points("1 1\n2 5\n7.283185 1\n"),
              ElementsAre(TablePoint{1.0, 1.0}, TablePoint{2.0, 5.0}));
  EXPECT_EQ(points("degree,k\n0,1\n180,5\n360,1\n").size(), 2U);
  EXPECT_EQ(points("share,k\n0,1\n0.5,5\n1,1\n").size(), 2U);
}

// At the beginning of the period, however it is written.
TEST(TableFile, MayJump) {
  const auto saw = ElementsAre(TablePoint{0.0, 1.0}, TablePoint{0.0, -1.0}, TablePoint{3.0, 0.0});
  EXPECT_THAT(points("0 1\n0 -1\n3 0\n"), saw);
  EXPECT_THAT(points("0 1\n0 -1\n3 0\n6.2831853 1\n"), saw);
  EXPECT_THAT(points("0 -1\n3 0\n6.2831853 1\n6.2831853 -1\n"), saw);
  EXPECT_THAT(points("0 1\n0 -1\n3 0\n6.2831853 1\n6.2831853 -1\n"), saw);
  EXPECT_EQ(points("0 1\n3 0\n3 2\n").size(), 3U);
}

TEST(TableFile, IsRefusedWithTheLine) {
  struct Case {
    std::string text, message;
  };
  std::string many, steps;
  for (int i = 0; i <= 100000; ++i) many += std::to_string(i * 6e-5) + " 1\n";
  for (int i = 0; i <= 100; ++i) {
    steps += std::to_string(i * 0.01) + " 1\n" + std::to_string(i * 0.01) + " 2\n";
  }
  const std::vector<Case> cases = {
      {"", "m.csv: a table of 0 points; it needs at least 2 in a period"},
      {"# nothing\n", "m.csv: a table of 0 points"},
      {"0 1\n", "m.csv: a table of 1 point; it needs at least 2"},
      {"0 1\n6.2831853 1\n", "m.csv: a table of 1 point; it needs at least 2 in a period"},
      {"0 1\n1 x\n", "m.csv:2: 'x' is not a number; write it as 0.5 or 5e-1"},
      {"0 1\n1 0x10\n", "m.csv:2: '0x10' is not a number"},
      {"0 1\n1 2,\n3,,4\n", "m.csv:3: 3 columns; a line has two"},
      {"0;1,5\n", "m.csv:1: 3 columns; a line has two, the phase and the value, and numbers have"},
      {"0 1\n1\n", "m.csv:2: 1 column; a line has two"},
      {"0 1\n1 nan\n", "m.csv:2: 'nan' is out of range; finite numbers up to 1e+100"},
      {"0 1\n1 -inf\n", "m.csv:2: '-inf' is out of range"},
      {"0 1\n1 1e200\n", "m.csv:2: '1e200' is out of range"},
      {"0 1\n1 1e999\n", "m.csv:2: '1e999' is not a number"},
      {"0 1\nnan 1\n", "m.csv:2: 'nan' is out of range"},
      {"angle,k\n0,1\n",
       "m.csv:1: 'angle' is neither a number nor what a first column is called: "
       "'phase' (in radians), 'share' (of the period) or 'degree'"},
      {"phase,k\nphase,k\n0,1\n", "m.csv:2: 'phase' is not a number"},
      {"0 1\n2 1\n1.5 1\n", "m.csv:3: phase 1.5 follows 2; phases must rise"},
      {"0 1\n1 1\n1.00001 1\n",
       "m.csv:3: phase 1.00001 is closer to the one before than 3e-05 rad"},
      {"0 1\n1 1\n1 2\n1 3\n", "m.csv:4: a third point at phase 1; two are a jump"},
      {steps, "m.csv:202: more than 100 jumps"},
      {"0 1\n180 1\n",
       "m.csv:2: phase 180 is outside of the period from 0 to 6.28319; other first "
       "columns are 'phase', 'share' and 'degree'"},
      {"-1 1\n0 1\n", "m.csv:1: phase -1 is outside of the period"},
      {"7 1\n8 1\n", "m.csv:1: phase 7 is outside of the period"},
      {"degree k\n10 1\n380 1\n", "m.csv:3: degree 380 is outside of the period from 10 to 370"},
      {"0 1\n3 2\n6.2831853 1.5\n",
       "m.csv:3: a table that is not periodic: 1.5 at its end, 1 at "
       "its beginning"},
      {"0 1\n0 2\n3 2\n6.2831853 2\n", "m.csv:4: a table that is not periodic: 2 at its end, 1 at"},
      {"0 1\n3 2\n6.2831853 1\n6.2831853 2\n", "m.csv:4: a table that is not periodic: 2 at its"},
      {many, "m.csv:100001: more than 100000 points"},
      {std::string("0 1\n\0 2\n", 8), "m.csv: not a text file; a table is columns of text"},
      {std::string((8 << 20) + 1, ' '), "m.csv: too large for a table"},
      {"0 1\n1 \x1b[31m\xff\n", "m.csv:2: '?[31m?' is not a number"},
      {"0 1\n1 " + std::string(1000, 'x'), "m.csv:2: '" + std::string(30, 'x') + "...' is not"}};
  for (const Case& wrong : cases) {
    EXPECT_THAT(refusal_of_table(wrong.text), StartsWith(wrong.message))
        << wrong.text.substr(0, 50);
  }
}

// What a study holds is what was read, to the bit.
TEST(TableFile, IsTheSameWhenWrittenAndReadAgain) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const std::string unit : {"phase", "share", "degree"}) {
    const double turn = unit == "phase" ? kTurnOfTable : unit == "share" ? 1.0 : 360.0;
    std::string text = unit + ",k\n";
    for (int i = 0; i < 1000; ++i) {
      const double value = std::ldexp(share(random) - 0.5, i % 600 - 300);
      const double phase = turn * (i + 0.5 * share(random)) / 1000;
      text += std::to_string(phase) + "," + fmt::format("{}", value) + "\n";
    }
    const std::vector<TablePoint> read = points(text);
    EXPECT_EQ(points(table_text(read)), read);
    EXPECT_EQ(read.size(), 1000U);
  }
  const std::vector<TablePoint> jumps = points("0 -1\n3 0\n3 0.1\n6.2831853 1\n6.2831853 -1\n");
  EXPECT_EQ(points(table_text(jumps)), jumps);
}

// With a decimal comma, whether or not the machine has a language that writes one.
TEST(TableFile, IsTheSameInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::string text = "0 1.5\n0.25 -2.5\n";
  const std::vector<TablePoint> read = points(text);
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string was = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(points(text), read);
  EXPECT_EQ(table_text(read), text);
  std::setlocale(LC_ALL, was.c_str());
  std::locale::global(before);
}

TEST(TableFile, LiesBesideItsModel) {
  const Folder folder;
  folder.write("m.csv", "0 1\n1 2\n");
  folder.write("wrong.csv", "0 1\n1 x\n");
  std::filesystem::create_directory(folder / "sub");
  const TablePoints beside = tables_beside((folder / "model.toml").string());
  const auto expected = ElementsAre(TablePoint{0.0, 1.0}, TablePoint{1.0, 2.0});
  EXPECT_THAT(beside("m.csv"), expected);
  EXPECT_THAT(beside("sub/../m.csv"), expected);
  EXPECT_THAT(tables_beside("elsewhere/model.toml")((folder / "m.csv").string()), expected);
  EXPECT_THAT(refusal_of([&] { beside("wrong.csv"); }), HasSubstr("/wrong.csv:2: 'x' is not"));
  EXPECT_THAT(refusal_of([&] { beside("missing.csv"); }),
              HasSubstr("missing.csv: there is no such file"));
  EXPECT_THAT(refusal_of([&] { beside("sub"); }),
              HasSubstr("is a folder; a table must be a regular file"));
  EXPECT_THAT(refusal_of([&] { beside("/dev/null"); }), HasSubstr("is a device"));
}

}  // namespace
}  // namespace gearsweep::testing
