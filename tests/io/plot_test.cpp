// Every kind of picture is drawn by gnuplot without complaint, and what cannot be drawn is refused.
#include "io/plot.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>

#include "io/example_result.hpp"
#include "io/gnuplot.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::spectrum_result;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PlotTest : public gearsweep::testing::IoTest {
 protected:
  // The first bytes of the picture that the request draws.
  std::string drawn(PlotRequest request, const std::string& ending = ".png") const {
    request.output_path = in_folder("picture" + ending);
    plot_files(request);
    return content(request.output_path).substr(0, 200);
  }

  // The script of a picture; drawing it must make gnuplot say nothing.
  std::string script_of(PlotRequest request, const std::string& ending = ".png") const {
    request.script_path = in_folder("picture.gp");
    EXPECT_THAT(drawn(request, ending), AnyOf(StartsWith("\x89PNG"), HasSubstr("<svg")));
    const std::string said = in_folder("said.txt");
    const std::string command =
        "cd / && gnuplot '" + request.script_path + "' > '" + said + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(content(said), "");
    return content(request.script_path);
  }
};

TEST_F(PlotTest, TheEndingChoosesTheFormat) {
  const std::string path = write(example_result());
  EXPECT_THAT(drawn({{path}, "x1_rms", "", "", {}, {}, {}}, ".png"), StartsWith("\x89PNG"));
  EXPECT_THAT(drawn({{path}, "x1_rms", "", "", {}, {}, {}}, ".pdf"), StartsWith("%PDF"));
  EXPECT_THAT(drawn({{path}, "x1_rms", "", "", {}, {}, {}}, ".svg"), HasSubstr("<svg"));
}

// The locale of this process and of those that it starts, until the end of the scope.
class Locale {
 public:
  explicit Locale(const char* name) {
    if (const char* before = std::getenv("LC_ALL")) before_ = before;
    setenv("LC_ALL", name, 1);
  }
  ~Locale() {
    if (before_) {
      setenv("LC_ALL", before_->c_str(), 1);
    } else {
      unsetenv("LC_ALL");
    }
  }
  Locale(const Locale&) = delete;
  Locale& operator=(const Locale&) = delete;

 private:
  std::optional<std::string> before_;
};

// One without UTF-8, one that every Debian has, and one that most have not, with a decimal comma
// where it is there.
TEST_F(PlotTest, ThePictureAndItsScriptDrawTheSameInEveryLocale) {
  SweepResult result = example_result(7, 0);
  result.study.title = "mit Reibung, größer";
  const std::string first = write(result, "first.nc");
  result.study.title = "ohne Dämpfung ζ";
  const std::string second = write(result, "second.nc");
  for (const std::string ending : {".png", ".svg"}) {
    std::set<std::string> pictures;
    for (const char* const name : {"C", "C.UTF-8", "de_DE.UTF-8"}) {
      const Locale locale(name);
      EXPECT_GT(script_of({{first, second}, "x1_rms", "", "", {}, {}, {}}, ending).size(), 0U);
      pictures.insert(content(in_folder("picture" + ending)));
      plot_files({{first, second}, "x1_rms", in_folder("own" + ending), "", {}, {}, {}});
      pictures.insert(content(in_folder("own" + ending)));
    }
    EXPECT_EQ(pictures.size(), 1U) << ending;
  }
}

TEST_F(PlotTest, AnEvenGridIsAnImageWithGreyForWhatDiverged) {
  const std::string script = script_of({{write(example_result())}, "", "", "", {}, {}, {}});
  EXPECT_THAT(script,
              AllOf(HasSubstr("with image"), HasSubstr("set ylabel \"half backlash, b"),
                    HasSubstr("mesh frequency / ϖ, omega\""), HasSubstr("x1\\\\_rms [b_{n}]"),
                    HasSubstr("diverged at 1 of 12 points")));
}

TEST_F(PlotTest, AnUnevenOrLogarithmicGridIsMadeOfBoxes) {
  SweepResult result = example_result();
  result.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
  EXPECT_THAT(script_of({{write(result)}, "x1_rms", "", "", {}, {}, {}}),
              HasSubstr("with boxxyerror"));
  result.study.axes[0].logarithmic = true;
  EXPECT_THAT(script_of({{write(result)}, "x1_rms", "", "", {}, {}, {}}),
              HasSubstr("set logscale x"));
}

TEST_F(PlotTest, ClassesHaveNamesAtTheColourBar) {
  const std::string path = write(example_result());
  EXPECT_THAT(script_of({{path}, "contact_class", "", "", {}, {}, {}}),
              HasSubstr("set cbtics (\"no impact\" 0, \"single sided\" 1, \"double sided\" 2, "
                        "\"wedged\" 3)"));
  EXPECT_THAT(script_of({{path}, "status", "", "", {}, {}, {}}), HasSubstr("\"diverged\" 1"));
}

TEST_F(PlotTest, AMapWithoutAnyValueIsDrawnGrey) {
  SweepResult result = example_result();
  result.status.assign(12, 1);
  for (auto& map : result.values) map.assign(12, kNaN);
  EXPECT_THAT(script_of({{write(result)}, "x1_rms", "", "", {}, {}, {}}),
              HasSubstr("12 of 12 points"));
  result.study.axes[0].logarithmic = true;
  EXPECT_THAT(script_of({{write(result)}, "contact_class", "", "", {}, {}, {}}),
              HasSubstr("NaN notitle"));
  SweepResult line = example_result(7, 0);
  line.status.assign(7, 1);
  line.samples.assign(line.samples.size(), kNaN);
  for (auto& map : line.values) map.assign(7, kNaN);
  for (const char* const quantity : {"poincare", "x1_rms", "poincare,x1_rms,contact_class"}) {
    EXPECT_THAT(drawn({{write(line)}, quantity, "", "", {}, {}, {}}), StartsWith("\x89PNG"));
  }
}

TEST_F(PlotTest, OneAxisIsACurveAndACutMakesOne) {
  SweepResult result = example_result(7, 0);
  EXPECT_THAT(script_of({{write(result)}, "x1_rms", "", "", {}, {}, {}}), HasSubstr("linespoints"));
  EXPECT_THAT(script_of({{write(result)}, "contact_class", "", "", {}, {}, {}}),
              HasSubstr("set ytics (\"no impact\" 0"));
  EXPECT_THAT(script_of({{write(example_result())}, "x1_rms", "", "", {{"b", 1.0}}, {}, {}}),
              AllOf(HasSubstr("b = 0.9 b_{n}"), HasSubstr("diverged at 1 of 4 points")));
}

TEST_F(PlotTest, PoincareIsABifurcationDiagram) {
  const std::string path = write(example_result(7, 0));
  EXPECT_THAT(script_of({{path}, "", "", "", {}, {}, {}}), HasSubstr("set ylabel \"x1 [b_{n}]\""));
  EXPECT_THAT(script_of({{path}, "poincare:v1", "", "", {}, {}, {}}),
              HasSubstr("set ylabel \"v1 [b_{n} ϖ]\""));
  const std::string map = write(example_result());
  EXPECT_THAT(script_of({{map}, "poincare", "", "", {{"omega", 2.0}}, {}, {}}),
              AllOf(HasSubstr("with points"), HasSubstr("omega = 2")));
  EXPECT_THAT(refusal([&] {
                drawn({{map}, "poincare", "", "", {}, {}, {}});
              }),
              AllOf(HasSubstr("axes 'omega' and 'b'"), HasSubstr("cut it")));
}

TEST_F(PlotTest, ManySamplesAreShownByTheirDensity) {
  SweepResult result = example_result(200, 0);
  result.study.integrate.record = 100;
  result.samples.assign(200 * 2 * 100, 0.5);
  result.samples[7] = 0.6;
  EXPECT_THAT(script_of({{write(result)}, "poincare", "", "", {}, {}, {}}),
              AllOf(HasSubstr("with points"), Not(HasSubstr("share of the samples"))));
  result.study.integrate.record = 101;
  result.samples.assign(200 * 2 * 101, 0.5);
  EXPECT_THAT(script_of({{write(result)}, "poincare", "", "", {}, {}, {}}),
              HasSubstr("share of the samples"));
}

TEST_F(PlotTest, AnExponentOfBothSignsIsWhiteAtZero) {
  const std::string path = write(spectrum_result());
  // Exponent 3 goes from 0 up, 4 from -0.1 to 0.01, 9 stays below zero.
  const std::string script = script_of({{path}, "lyapunov_spectrum:4", "", "", {}, {}, {}});
  EXPECT_THAT(script, AllOf(HasSubstr("0 '#ffffff'"), HasSubstr("set cbrange [-0.1"),
                            HasSubstr("lyapunov\\\\_spectrum:4 [1/τ]")));
  EXPECT_THAT(script_of({{path}, "lyapunov_spectrum:9", "", "", {}, {}, {}}),
              Not(HasSubstr("#ffffff")));
  EXPECT_THAT(script_of({{path}, "lyapunov_spectrum", "", "", {}, {}, {}}),
              HasSubstr("lyapunov\\\\_spectrum:1"));
}

TEST_F(PlotTest, OverOneAxisASpectrumIsACurveForEachExponent) {
  const std::string path = write(spectrum_result(7, 0));
  const std::string all = script_of({{path}, "lyapunov_spectrum", "", "", {}, {}, {}});
  EXPECT_THAT(all, AllOf(HasSubstr("format='%11double'"), HasSubstr("using 1:11"),
                         HasSubstr("title \"exponent 2 to 10\""), HasSubstr("using 1:2 "),
                         HasSubstr("title \"exponent 1\""), HasSubstr("xzeroaxis"),
                         HasSubstr("diverged at 1 of 7 points")));
  EXPECT_THAT(script_of({{path}, "lyapunov_spectrum:2", "", "", {}, {}, {}}),
              AllOf(HasSubstr("format='%2double'"), Not(HasSubstr("exponent 2 to"))));
  const std::string map = write(spectrum_result());
  EXPECT_THAT(script_of({{map}, "lyapunov_spectrum", "", "", {{"b", 1.5}}, {}, {}}),
              AllOf(HasSubstr("b = 1.5"), HasSubstr("exponent 2 to 10")));
}

TEST_F(PlotTest, QuantitiesOfOneAxisStandAboveOneAnother) {
  const std::string script = script_of(
      {{write(spectrum_result(7, 0))}, "lyapunov_max,lyapunov_spectrum", "", "", {}, {}, {}});
  EXPECT_THAT(script, AllOf(HasSubstr("set multiplot"), HasSubstr("lyapunov\\\\_max"),
                            HasSubstr("exponent 2 to 10"), HasSubstr("diverged at 1 of 7 points"),
                            HasSubstr("set format x ''")));
  // Only the lowest panel has the shared axis.
  EXPECT_EQ(script.find("unset xlabel"), script.rfind("unset xlabel"));
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(script_of({{line}, "poincare,x1_rms,contact_class", "", "", {}, {}, {}}),
              AllOf(HasSubstr("set ylabel \"x1 [b_{n}]\""), HasSubstr("x1\\\\_rms"),
                    HasSubstr("set ytics (\"no impact\" 0")));
  const std::string map = write(example_result());
  EXPECT_THAT(script_of({{map}, "x1_rms,contact_class", "", "", {{"b", 1.0}}, {}, {}}),
              HasSubstr("at b = 0.9"));
}

TEST_F(PlotTest, StudiesOfOneAxisLieOverOneAnother) {
  SweepResult result = example_result(7, 0);
  const std::string first = write(result, "first.nc");
  const std::string second = write(result, "second.nc");
  for (const char* const quantity : {"x1_rms", "poincare:v1", "contact_class", "status,x1_rms"}) {
    EXPECT_THAT(script_of({{first, second}, quantity, "", "", {}, {}, {}}),
                AllOf(HasSubstr("title \"first\""), HasSubstr("title \"second\"")))
        << quantity;
  }
  // Titles that differ say more than files; values of both axes are shown.
  result.study.title = "without friction";
  result.study.axes[0].values = {2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0};
  const std::string other = write(result, "other.nc");
  EXPECT_THAT(script_of({{first, other}, "x1_rms", "", "", {}, {}, {}}),
              AllOf(HasSubstr("title \"without friction\""), HasSubstr("coarse"),
                    HasSubstr("without friction: diverged at 1 of 7 points"), HasSubstr(":5.25]")));
}

TEST_F(PlotTest, WhatDoesNotShareOneAxisIsNotLaidOver) {
  const std::string map = write(example_result(), "map.nc");
  const std::string line = write(example_result(7, 0), "line.nc");
  SweepResult result = example_result(7, 0);
  result.study.axes[0].name = "e0";
  const std::string other = write(result, "other.nc");
  const std::string png = in_folder("a.png");
  const auto refused = [&](const std::vector<std::string>& paths, const std::string& quantity) {
    return refusal([&] { plot_files({paths, quantity, png, "", {}, {}, {}}); });
  };
  EXPECT_THAT(refused({map, map}, "x1_rms"),
              AllOf(HasSubstr("'omega' and 'b'"), HasSubstr("--at")));
  EXPECT_THAT(refused({map}, "x1_rms,status"), HasSubstr("'omega' and 'b'"));
  EXPECT_THAT(refused({line, other}, "x1_rms"), HasSubstr("over the axis 'e0'"));
  EXPECT_THAT(refused({line}, "x1_rms,contact_clas"), HasSubstr("did you mean 'contact_class'?"));
  EXPECT_THAT(refused({line, line, line, line, line, line, line}, "x1_rms"), HasSubstr("7 are"));
  EXPECT_THAT(refusal([&] {
                plot_files({{line}, "x1_rms", png, "", {}, 3, {}});
              }),
              HasSubstr("--periods"));
  EXPECT_EQ(files(), 3U);
}

TEST_F(PlotTest, OddGridsAreDrawn) {
  EXPECT_THAT(script_of({{write(example_result(1, 1))}, "x1_rms", "", "", {}, {}, {}}),
              HasSubstr("with boxxyerror"));
  EXPECT_THAT(script_of({{write(example_result(1, 0))}, "x1_rms", "", "", {}, {}, {}}),
              HasSubstr("set yrange"));
}

TEST_F(PlotTest, NothingInATitleIsACommand) {
  SweepResult result = example_result();
  const std::string trap = in_folder("trap");
  result.study.title = "`touch " + trap + "` it's \"50 %\" {x}^2 \\n @a & b_c $d '.system('x').'";
  script_of({{write(result)}, "x1_rms", "", "", {}, {}, {}});
  EXPECT_FALSE(fs::exists(trap));
}

// The letters of an SVG picture, without its elements.
std::string letters_of(const std::string& svg) {
  std::string letters;
  bool is_inside = true;
  for (const char letter : svg) {
    if (letter == '<') is_inside = false;
    if (is_inside && letter != '\n' && letter != '\t') letters += letter;
    if (letter == '>') is_inside = true;
  }
  for (const auto& [name, letter] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (std::size_t at = 0; (at = letters.find(name, at)) != std::string::npos; ++at) {
      letters.replace(at, std::strlen(name), letter);
    }
  }
  return letters;
}

// A stranger's file: gnuplot has formats, markup and escapes, and each kind of text its own.
TEST_F(PlotTest, EveryTextOfAFileIsShownLetterByLetter) {
  const std::string odd = "%s%n%5.3f{x}^2@a&b~c\\U+0041\\n\\101$d'q'\"r\"<t>#%%";
  for (const bool is_map : {true, false}) {
    SweepResult result = example_result(4, is_map ? 3 : 0);
    result.study.title = "title" + odd;
    result.study.axes[0].unit = "unit" + odd;
    result.study.axes[0].meaning = "meaning" + odd.substr(0, 20);
    Quantity& quantity = result.study.selection.quantities[1];
    quantity.meaning = "long" + odd;
    quantity.flags = {"flag" + odd.substr(0, 30), "%d", "100%"};
    const std::string path = write(result);
    const std::string picture = in_folder("picture.svg");
    plot_files({{path}, "contact_class", picture, "", {}, {}, {}});
    const std::string letters = letters_of(content(picture));
    for (const std::string& text :
         {result.study.title, result.study.axes[0].unit, result.study.axes[0].meaning,
          quantity.meaning, quantity.flags[0], quantity.flags[1], quantity.flags[2]}) {
      EXPECT_THAT(letters, HasSubstr(text));
    }
    const std::string second = write(result, "%s{y}^2&z.nc");
    if (!is_map) {
      plot_files({{path, second}, "contact_class,x1_rms", picture, "", {}, {}, {}});
      EXPECT_THAT(letters_of(content(picture)), AllOf(HasSubstr("%s{y}^2&z"), HasSubstr("100%")));
    }
  }
}

// gnuplot takes a minute over a title of 15 MB.
TEST_F(PlotTest, ATextThatNobodyReadsIsCutShort) {
  SweepResult result = example_result(7, 0);
  const std::string large(100'000, 'x');
  result.study.title = large;
  result.study.axes[0].unit = large;
  result.study.axes[0].meaning = large;
  for (Quantity& quantity : result.study.selection.quantities) {
    quantity.unit = large;
    quantity.meaning = large;
  }
  result.study.selection.quantities[1].flags = {large, "b", "c"};
  const std::string path = write(result);
  for (const char* const quantity : {"x1_rms", "contact_class", "poincare,x1_rms,contact_class"}) {
    EXPECT_LT(script_of({{path}, quantity, "", "", {}, {}, {}}).size(), 20'000U);
  }
  const std::string other = write(result, "other.nc");
  EXPECT_LT(script_of({{path, other}, "x1_rms", "", "", {}, {}, {}}).size(), 20'000U);
}

TEST_F(PlotTest, OddNamesOfFilesWork) {
  fs::create_directory(folder_ / "it's {here} ü");
  PlotRequest request;
  request.paths = {write(example_result())};
  request.output_path = in_folder("it's {here} ü/'a' \\@b \"`c`.png");
  request.script_path = in_folder("it's {here} ü/'@b' \"`c`.gp");
  plot_files(request);
  EXPECT_THAT(content(request.output_path), StartsWith("\x89PNG"));
  fs::remove(request.output_path);
  run_gnuplot(request.script_path);
  EXPECT_THAT(content(request.output_path), StartsWith("\x89PNG"));
}

TEST_F(PlotTest, WhatCannotBeDrawnIsRefusedAndLeavesNoFile) {
  const std::string path = write(example_result());
  const auto refused = [&](const PlotRequest& request) {
    return refusal([&] { plot_files(request); });
  };
  const std::string png = in_folder("a.png");
  EXPECT_THAT(refused({{path}, "x1_rms", in_folder("a.jpg"), "", {}, {}, {}}),
              HasSubstr(".png, .svg or .pdf"));
  EXPECT_THAT(refused({{path}, "x1_rms", png, in_folder("a.txt"), {}, {}, {}}),
              HasSubstr("end in .gp"));
  EXPECT_THAT(refused({{path}, "x1_rsm", png, in_folder("a.gp"), {}, {}, {}}),
              HasSubstr("did you mean"));
  EXPECT_THAT(refused({{path}, "x1_rms", png, "", {{"b", 9.0}}, {}, {}}),
              HasSubstr("outside the axis"));
  EXPECT_THAT(refused({{path}, "x1_rms", in_folder("missing/a.png"), "", {}, {}, {}}),
              HasSubstr("there is no folder"));
  EXPECT_EQ(files(), 1U);
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(refused({{line}, "x1_rms", png, "", {{"b", 1.0}}, {}, {}}),
              HasSubstr("has one axis"));
}

TEST_F(PlotTest, AMissingOrFailingGnuplotIsTold) {
  const auto failure = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const RunError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string script = in_folder("wrong.gp");
  std::ofstream(script) << "plot 'no_such_file'\n";
  EXPECT_THAT(failure([&] { run_gnuplot(script); }), HasSubstr("no_such_file"));
  fs::remove(script);
  const std::string path = write(example_result());
  const std::string before = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const std::string said = failure([&] {
    plot_files({{path}, "", in_folder("a.png"), "", {}, {}, {}});
  });
  setenv("PATH", before.c_str(), 1);
  EXPECT_THAT(said, HasSubstr("install it"));
  EXPECT_EQ(files(), 1U);
}

TEST(ColourRange, LeavesOutliersOutOnlyWhenTheyTakeTheContrast) {
  std::vector<double> values(2000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 1999.0;
  EXPECT_FALSE(colour_range(values).clipped);
  values[3] = 1e6;
  values[4] = kNaN;
  EXPECT_TRUE(colour_range(values).clipped);
  EXPECT_LE(colour_range(values).greatest, 1.0);
  const ValueRange constant = colour_range({2.0, 2.0});
  EXPECT_LT(constant.least, 2.0);
  EXPECT_GT(constant.greatest, 2.0);
}

TEST(ClassScale, AFewWholeNumbersAreClasses) {
  ResultMap map;
  map.values = {1.0, 2.0, 8.0, kNaN, 2.0};
  const auto scale = class_scale(map);
  ASSERT_TRUE(scale.has_value());
  EXPECT_THAT(scale->names, ElementsAre("1", "2", "8"));
  EXPECT_EQ(scale->index_of(8.0), 2.0);
  EXPECT_TRUE(std::isnan(scale->index_of(kNaN)));
  map.values.push_back(0.5);
  EXPECT_FALSE(class_scale(map).has_value());
}

// A map of periods: hundreds of values, but few that matter.
TEST(ClassScale, WholeNumbersThatHardlyOccurAreOneClass) {
  ResultMap map;
  for (int period = 0; period < 9; ++period) map.values.insert(map.values.end(), 20, period);
  for (int period = 100; period < 115; ++period) map.values.push_back(period);
  const auto scale = class_scale(map);
  ASSERT_TRUE(scale.has_value());
  EXPECT_THAT(scale->names, ElementsAre("0", "1", "2", "3", "4", "5", "6", "7", "8", "other"));
  EXPECT_EQ(scale->index_of(8.0), 8.0);
  EXPECT_EQ(scale->index_of(107.0), 9.0);
  EXPECT_TRUE(std::isnan(scale->index_of(kNaN)));
  EXPECT_EQ(scale->colours.size(), 10U);
  // Where none stands out, the numbers are shades.
  for (int period = 200; period < 400; ++period) map.values.push_back(period);
  EXPECT_FALSE(class_scale(map).has_value());
}

TEST(PlotText, SymbolsAreSetAsInPrint) {
  EXPECT_EQ(typeset("k0 b_n"), "k_{0} b_{n}");
  EXPECT_EQ(label_of("x1_rms", "b_n varpi"), "x1\\_rms [b_{n} ϖ]");
  EXPECT_EQ(label_of("period", "1"), "period");
}

}  // namespace
}  // namespace gearsweep
