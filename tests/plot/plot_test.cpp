// Every kind of picture is drawn by gnuplot without complaint, and what cannot be drawn is refused.
#include "plot/plot.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>

#include "plot/detail/gnuplot.hpp"
#include "plot/detail/text.hpp"
#include "result/example_result.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::make_axis;
using gearsweep::testing::spectrum_result;
using ::testing::AllOf;
using ::testing::AnyOf;
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
  EXPECT_THAT(drawn({.paths = {path}, .quantity = "x1_rms"}, ".png"), StartsWith("\x89PNG"));
  EXPECT_THAT(drawn({.paths = {path}, .quantity = "x1_rms"}, ".pdf"), StartsWith("%PDF"));
  EXPECT_THAT(drawn({.paths = {path}, .quantity = "x1_rms"}, ".svg"), HasSubstr("<svg"));
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
      EXPECT_GT(script_of({.paths = {first, second}, .quantity = "x1_rms"}, ending).size(), 0U);
      pictures.insert(content(in_folder("picture" + ending)));
      plot_files({.paths = {first, second},
                  .quantity = "x1_rms",
                  .output_path = in_folder("own" + ending)});
      pictures.insert(content(in_folder("own" + ending)));
    }
    EXPECT_EQ(pictures.size(), 1U) << ending;
  }
}

TEST_F(PlotTest, AnEvenGridIsAnImageWithGreyForWhatDiverged) {
  const std::string script = script_of({.paths = {write(example_result())}});
  EXPECT_THAT(script, AllOf(HasSubstr("array=(4,3)"), HasSubstr("with image"),
                            HasSubstr("\"half backlash {/:Italic b} ({/:Italic b}_{n})\""),
                            HasSubstr("\"mesh frequency {/:Italic ω}/{/:Italic ϖ}\""),
                            HasSubstr("\"rms of {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                            HasSubstr("diverged at 1 of 12 points")));
}

TEST_F(PlotTest, AnInitialStateIsCalledByItsSymbol) {
  SweepResult result = example_result();
  result.study.axes[0] =
      make_axis("x1", "b_n", "initial torsional mesh displacement", -1.0, 4.0, 4);
  result.study.axes[1] = make_axis("v1", "b_n varpi", "initial velocity of x1", -1.5, 1.5, 3);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("\"initial {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                    HasSubstr("\"initial {/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})\"")));
}

// Boxes that only touch would show bright seams in vector formats.
TEST_F(PlotTest, AnUnevenOrLogarithmicGridIsAnImageToo) {
  SweepResult result = example_result();
  result.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("array=(1000,3)"), Not(HasSubstr("boxxyerror"))));
  result.study.axes[0].logarithmic = true;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("set logscale x"), HasSubstr("array=(4,3)")));
}

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

// Where shapes of a vector format touch, viewers show seams; pixels of an image have none.
TEST_F(PlotTest, NoMapAndNoColourBarIsMadeOfShapes) {
  SweepResult even = example_result(), uneven = example_result();
  for (double& value : even.values[0]) value = 0.7;
  uneven.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
  for (const SweepResult& result : {even, uneven}) {
    for (const char* const quantity : {"x1_rms", "contact_class"}) {
      const std::string picture = in_folder("picture.svg");
      plot_files({.paths = {write(result)}, .quantity = quantity, .output_path = picture});
      const std::string svg = content(picture);
      EXPECT_EQ(count_of("<image", svg), 2U) << quantity;
      // The ground of what diverged and its box in the key.
      EXPECT_LE(count_of("<polygon", svg), 2U) << quantity;
    }
  }
}

TEST_F(PlotTest, ClassesHaveNamesAtTheColourBar) {
  const std::string path = write(example_result());
  // Classes that do not occur take no room.
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "contact_class"}),
              AllOf(HasSubstr("(\"no impact\" 0, \"single sided\" 1, \"double sided\" 2)"),
                    Not(HasSubstr("\"wedged\""))));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "status"}), HasSubstr("\"diverged\" 1"));
}

TEST_F(PlotTest, AMapWithoutAnyValueIsDrawnGrey) {
  SweepResult result = example_result();
  result.status.assign(12, 1);
  for (auto& map : result.values) map.assign(12, kNaN);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              HasSubstr("12 of 12 points"));
  result.study.axes[0].logarithmic = true;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "contact_class"}),
              HasSubstr("12 of 12 points"));
  SweepResult line = example_result(7, 0);
  line.status.assign(7, 1);
  line.samples.assign(line.samples.size(), kNaN);
  for (auto& map : line.values) map.assign(7, kNaN);
  for (const char* const quantity : {"poincare", "x1_rms", "poincare,x1_rms,contact_class"}) {
    EXPECT_THAT(drawn({.paths = {write(line)}, .quantity = quantity}), StartsWith("\x89PNG"));
  }
}

TEST_F(PlotTest, OneAxisIsACurveAndACutMakesOne) {
  SweepResult result = example_result(7, 0);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              HasSubstr("linespoints"));
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "contact_class"}),
              HasSubstr("(\"no impact\" 0"));
  EXPECT_THAT(
      script_of({.paths = {write(example_result())}, .quantity = "x1_rms", .at = {{"b", 1.0}}}),
      AllOf(HasSubstr("at {/:Italic b} = 0.9 {/:Italic b}_{n}"),
            HasSubstr("diverged at 1 of 4 points")));
}

TEST_F(PlotTest, PoincareIsABifurcationDiagram) {
  const std::string path = write(example_result(7, 0));
  EXPECT_THAT(script_of({.paths = {path}}), HasSubstr("\"{/:Italic x}_{1} ({/:Italic b}_{n})\""));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "poincare:v1"}),
              HasSubstr("\"{/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})\""));
  const std::string map = write(example_result());
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "poincare", .at = {{"omega", 2.0}}}),
              AllOf(HasSubstr("with points"), HasSubstr("{/:Italic ω} = 2")));
  EXPECT_THAT(refusal([&] { drawn({.paths = {map}, .quantity = "poincare"}); }),
              AllOf(HasSubstr("axes 'omega' and 'b'"), HasSubstr("cut it")));
}

// As the transparency in '#aarrggbb' of the dots.
int transparency_in(const std::string& script) {
  const std::size_t colour = script.find("linecolor rgb '#", script.find("pointtype 7"));
  return std::stoi(script.substr(colour + 16, 2), nullptr, 16);
}

// The script keeps the samples; where they are many, each is pale.
TEST_F(PlotTest, ManySamplesAreShownByTheirDensity) {
  SweepResult result = example_result(200, 0);
  result.study.integrate.record = 5;
  result.samples.assign(200 * 2 * 5, 0.5);
  result.samples[7] = 0.6;
  const PlotRequest few = {.paths = {write(result)}, .quantity = "poincare"};
  const std::string script = script_of(few);
  EXPECT_THAT(script, HasSubstr("record=(1000)"));
  EXPECT_LT(transparency_in(script), 30);
  result.study.integrate.record = 500;
  result.samples.assign(200 * 2 * 500, 0.5);
  const std::string dense = script_of({.paths = {write(result)}, .quantity = "poincare"});
  EXPECT_THAT(dense, HasSubstr("record=(100000)"));
  EXPECT_GT(transparency_in(dense), 100);
}

// In vector formats 100,000 dots would be megabytes.
TEST_F(PlotTest, DotsOfAVectorPictureAreOneImage) {
  SweepResult result = example_result(200, 0);
  result.study.integrate.record = 500;
  result.samples.resize(200 * 2 * 500);
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    result.samples[i] = std::fmod(0.618034 * static_cast<double>(i), 1.0);
  }
  for (const char* const ending : {".pdf", ".svg"}) {
    PlotRequest request = {.paths = {write(result)},
                           .quantity = "poincare",
                           .output_path = in_folder(std::string("p") + ending)};
    request.script_path = in_folder("dots.gp");
    plot_files(request);
    EXPECT_LT(content(request.output_path).size(), 500'000U) << ending;
    EXPECT_THAT(content(request.script_path),
                AllOf(HasSubstr("with rgbimage"), HasSubstr("record=(100000)")));
  }
}

TEST_F(PlotTest, AnExponentOfBothSignsIsWhiteAtZero) {
  const std::string path = write(spectrum_result());
  // Exponent 3 goes from 0 up, 4 from -0.1 to 0.01, 9 stays below zero.
  const std::string script = script_of({.paths = {path}, .quantity = "lyapunov_spectrum:4"});
  EXPECT_THAT(script, AllOf(HasSubstr("0 '#ffffff'"), HasSubstr("set cbrange [-0.1"),
                            HasSubstr("\"Lyapunov exponents 4 (1/{/:Italic τ})\"")));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "lyapunov_spectrum:9"}),
              Not(HasSubstr("#ffffff")));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "lyapunov_spectrum"}),
              HasSubstr("Lyapunov exponents 1"));
}

TEST_F(PlotTest, OverOneAxisASpectrumIsACurveForEachExponent) {
  const std::string path = write(spectrum_result(7, 0));
  const std::string all = script_of({.paths = {path}, .quantity = "lyapunov_spectrum"});
  EXPECT_THAT(all, AllOf(HasSubstr("format='%11double'"), HasSubstr("using 1:11"),
                         HasSubstr("set label \"exponent 2 to 10\""), HasSubstr("using 1:2 "),
                         HasSubstr("set label \"exponent 1\""), HasSubstr("xzeroaxis"),
                         HasSubstr("diverged at 1 of 7 points")));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "lyapunov_spectrum:2"}),
              AllOf(HasSubstr("format='%2double'"), Not(HasSubstr("exponent 2 to"))));
  const std::string map = write(spectrum_result());
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "lyapunov_spectrum", .at = {{"b", 1.5}}}),
              AllOf(HasSubstr("{/:Italic b} = 1.5"), HasSubstr("exponent 2 to 10")));
}

TEST_F(PlotTest, QuantitiesOfOneAxisStandAboveOneAnother) {
  const std::string script = script_of(
      {.paths = {write(spectrum_result(7, 0))}, .quantity = "lyapunov_max,lyapunov_spectrum"});
  EXPECT_THAT(script, AllOf(HasSubstr("set multiplot"), HasSubstr("\"largest Lyapunov\""),
                            HasSubstr("exponent 2 to 10"), HasSubstr("diverged at 1 of 7 points")));
  // Only the lowest panel has the shared axis.
  EXPECT_EQ(script.find("mesh frequency"), script.rfind("mesh frequency"));
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(script_of({.paths = {line}, .quantity = "poincare,x1_rms,contact_class"}),
              AllOf(HasSubstr("\"{/:Italic x}_{1} ({/:Italic b}_{n})\""), HasSubstr("rms of"),
                    HasSubstr("(\"no impact\" 0")));
  const std::string map = write(example_result());
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "x1_rms,contact_class", .at = {{"b", 1.0}}}),
              HasSubstr("at {/:Italic b} = 0.9"));
}

TEST_F(PlotTest, StudiesOfOneAxisLieOverOneAnother) {
  SweepResult result = example_result(7, 0);
  const std::string first = write(result, "first.nc");
  const std::string second = write(result, "second.nc");
  for (const char* const quantity : {"x1_rms", "poincare:v1", "contact_class", "status,x1_rms"}) {
    EXPECT_THAT(script_of({.paths = {first, second}, .quantity = quantity}),
                AllOf(HasSubstr("set label \"first\""), HasSubstr("set label \"second\"")))
        << quantity;
  }
  // Titles that differ say more than files; values of both axes are shown.
  result.study.title = "without friction";
  result.study.axes[0].values = {2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0};
  const std::string other = write(result, "other.nc");
  EXPECT_THAT(script_of({.paths = {first, other}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("set label \"without friction\""), HasSubstr("coarse"),
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
    return refusal([&] { plot_files({.paths = paths, .quantity = quantity, .output_path = png}); });
  };
  EXPECT_THAT(refused({map, map}, "x1_rms"),
              AllOf(HasSubstr("'omega' and 'b'"), HasSubstr("--at")));
  EXPECT_THAT(refused({map}, "x1_rms,status"), HasSubstr("'omega' and 'b'"));
  EXPECT_THAT(refused({line, other}, "x1_rms"), HasSubstr("over the axis 'e0'"));
  EXPECT_THAT(refused({line}, "x1_rms,contact_clas"), HasSubstr("did you mean 'contact_class'?"));
  EXPECT_THAT(refused({line, line, line, line, line, line, line}, "x1_rms"), HasSubstr("7 are"));
  EXPECT_THAT(
      refusal([&] {
        plot_files({.paths = {line}, .quantity = "x1_rms", .output_path = png, .periods = 3});
      }),
      HasSubstr("--periods"));
  EXPECT_EQ(files(), 3U);
}

TEST_F(PlotTest, OddGridsAreDrawn) {
  EXPECT_THAT(script_of({.paths = {write(example_result(1, 1))}, .quantity = "x1_rms"}),
              HasSubstr("with image"));
  EXPECT_THAT(script_of({.paths = {write(example_result(1, 0))}, .quantity = "x1_rms"}),
              HasSubstr("set yrange"));
}

TEST_F(PlotTest, NothingInATitleIsACommand) {
  SweepResult result = example_result();
  const std::string trap = in_folder("trap");
  result.study.title = "`touch " + trap + "` it's \"50 %\" {x}^2 \\n @a & b_c $d '.system('x').'";
  script_of({.paths = {write(result)}, .quantity = "x1_rms"});
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
    plot_files({.paths = {path}, .quantity = "contact_class", .output_path = picture});
    const std::string letters = letters_of(content(picture));
    for (const std::string& text :
         {result.study.title, result.study.axes[0].unit, result.study.axes[0].meaning,
          quantity.meaning, quantity.flags[0], quantity.flags[1], quantity.flags[2]}) {
      EXPECT_THAT(letters, HasSubstr(text));
    }
    const std::string second = write(result, "%s{y}^2&z.nc");
    if (!is_map) {
      plot_files(
          {.paths = {path, second}, .quantity = "contact_class,x1_rms", .output_path = picture});
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
    EXPECT_LT(script_of({.paths = {path}, .quantity = quantity}).size(), 20'000U);
  }
  const std::string other = write(result, "other.nc");
  EXPECT_LT(script_of({.paths = {path, other}, .quantity = "x1_rms"}).size(), 20'000U);
}

// Who restyles a script draws other data with it.
TEST_F(PlotTest, AKeptScriptTakesPictureAndData) {
  script_of({.paths = {write(example_result())}, .quantity = "x1_rms"});
  fs::rename(in_folder("picture.dat"), in_folder("other.dat"));
  const std::string command = "cd '" + folder_.string() + "' && gnuplot -c picture.gp again.png";
  EXPECT_NE(std::system((command + " 2> said.txt").c_str()), 0);
  EXPECT_EQ(std::system((command + " other.dat").c_str()), 0);
  EXPECT_THAT(content(in_folder("again.png")), StartsWith("\x89PNG"));
}

TEST_F(PlotTest, ABarWithPointedEndsLeavesValuesOut) {
  SweepResult result = example_result(50, 40);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              Not(HasSubstr("polygon")));
  result.values[0][7] = 1e6;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("set object polygon"), HasSubstr("99.8 %")));
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
  EXPECT_THAT(refused({.paths = {path}, .quantity = "x1_rms", .output_path = in_folder("a.jpg")}),
              HasSubstr(".png, .svg, .pdf or .tex"));
  EXPECT_THAT(refused({{path}, "x1_rms", png, in_folder("a.txt"), {}, {}, {}}),
              HasSubstr("end in .gp"));
  EXPECT_THAT(refused({{path}, "x1_rsm", png, in_folder("a.gp"), {}, {}, {}}),
              HasSubstr("did you mean"));
  EXPECT_THAT(
      refused({.paths = {path}, .quantity = "x1_rms", .output_path = png, .at = {{"b", 9.0}}}),
      HasSubstr("outside the axis"));
  EXPECT_THAT(
      refused({.paths = {path}, .quantity = "x1_rms", .output_path = in_folder("missing/a.png")}),
      HasSubstr("there is no folder"));
  EXPECT_EQ(files(), 1U);
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(
      refused({.paths = {line}, .quantity = "x1_rms", .output_path = png, .at = {{"b", 1.0}}}),
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
  const std::string said = failure(
      [&] { plot_files({.paths = {path}, .quantity = "", .output_path = in_folder("a.png")}); });
  setenv("PATH", before.c_str(), 1);
  EXPECT_THAT(said, HasSubstr("install it"));
  EXPECT_EQ(files(), 1U);
}

TEST(PlotText, SymbolsAreSetAsInPrint) {
  EXPECT_EQ(typeset("k0 b_n"), "{/:Italic k}_{0} {/:Italic b}_{n}");
  EXPECT_EQ(quantity_label("v1_max", "b_n varpi"),
            "largest {/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})");
  EXPECT_EQ(quantity_label("dmf_max", "k0 b_n"),
            "largest meshing force ({/:Italic k}_{0}{/:Italic b}_{n})");
  EXPECT_EQ(quantity_label("period", "1"), "period in forcing periods");
  EXPECT_EQ(quantity_label("my_own%thing", "1"), "my own%thing");
  EXPECT_EQ(settings_label("mu=0, teeth_ratio=2"), "{/:Italic μ} = 0, teeth ratio = 2");
}

}  // namespace
}  // namespace gearsweep
