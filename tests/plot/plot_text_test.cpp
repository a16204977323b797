// What is written in a picture: symbols as in print, and a stranger's text letter by letter.
#include <gmock/gmock.h>

#include <cstring>

#include "plot/detail/mathtext.hpp"
#include "plot/detail/text.hpp"
#include "plot/labels.hpp"
#include "plot/picture_test.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::make_axis;
using gearsweep::testing::PictureTest;
using ::testing::AllOf;
using ::testing::HasSubstr;
using PlotTextTest = PictureTest;

TEST_F(PlotTextTest, AnInitialStateIsCalledByItsSymbol) {
  SweepResult result = example_result();
  result.study.axes[0] =
      make_axis("x1", "b_n", "initial torsional mesh displacement", -1.0, 4.0, 4);
  result.study.axes[1] = make_axis("v1", "b_n varpi", "initial velocity of x1", -1.5, 1.5, 3);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("\"initial {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                    HasSubstr("\"initial {/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})\"")));
}

TEST_F(PlotTextTest, NothingInATitleIsACommand) {
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
TEST_F(PlotTextTest, EveryTextOfAFileIsShownLetterByLetter) {
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
TEST_F(PlotTextTest, ATextThatNobodyReadsIsCutShort) {
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

TEST(PlotText, AxesOfTracesSayWhatTheyAreOf) {
  EXPECT_EQ(channel_label({"x", "µm", "dynamic transmission error: the mesh deflection"}),
            "dynamic transmission error {/:Italic x} (µm)");
  EXPECT_EQ(channel_label({"v", "1", "velocity of x"}), "velocity {/:Italic v}");
  EXPECT_EQ(channel_label({"x1", "1", "displacement R_p theta_p - e(t)"}),
            "displacement {/:Italic x}_{1}");
  EXPECT_EQ(channel_label({"dmf_s1", "N", "force of sun and planet 1, without damping"}),
            "force of sun and planet 1 (N)");
  // What has words of its own, is a word itself, or says too much.
  EXPECT_EQ(channel_label({"dmf", "N", "dynamic meshing force"}), "meshing force (N)");
  EXPECT_EQ(channel_label({"push", "N", "a force"}), "push (N)");
  EXPECT_EQ(channel_label({"x", "1", "a meaning that is longer than an axis has room for"}),
            "{/:Italic x}");
  EXPECT_EQ(channel_label({"x", "1", ""}), "{/:Italic x}");
}

// For programs that draw with matplotlib: symbols between '$', and no other '$' that counts.
TEST(PlotText, SymbolsAreBetweenDollarsInMathtext) {
  EXPECT_EQ(quantity_mathtext("v1_max", "b_n varpi"),
            "largest $v$$_{\\mathrm{1}}$ ($b$$_{\\mathrm{n}}$$ϖ$)");
  EXPECT_EQ(typeset_mathtext("Rp theta_p"), "Rp $θ$$_{\\mathrm{p}}$");
  EXPECT_EQ(literal_mathtext("10 $, {a} x_1^2 \\alpha @~&"), "10 \\$, {a} x_1^2 \\alpha @~&");
  EXPECT_EQ(axis_mathtext({"omega", "varpi", "mesh frequency", {}, false}),
            "mesh frequency $ω$/$ϖ$");
  EXPECT_EQ(mathtext_of("{/:Italic x}_{1"), "$x$$_{\\mathrm{1}}$");
}

TEST(PlotText, PlacesAreInWords) {
  EXPECT_EQ(settings_label("pinion_speed_rpm=6000"), "pinion speed = 6000 rpm");
  EXPECT_EQ(settings_label("omega=0.7"), "{/:Italic ω} = 0.7");
  EXPECT_THAT(words_and_unit("mesh_stiffness_N_per_m"), ::testing::Pair("mesh stiffness", "N/m"));
}

// A parameter of a list does not have its name twice.
TEST(PlotText, ASymbolStandsOnce) {
  ResultAxis axis;
  axis.name = "e0";
  axis.meaning = "amplitude of the error (e0)";
  axis.unit = "1";
  EXPECT_EQ(axis_label(axis), "amplitude of the error {/:Italic e}_{0}");
}

TEST(PlotText, SeveralContactsAndForcesAreTold) {
  EXPECT_EQ(quantity_label("second_contact_gap", "1"), "share of time without contact (second)");
  EXPECT_EQ(quantity_label("dmf2_dynamic_load_factor", "1"), "dynamic load factor (dmf2)");
  EXPECT_EQ(quantity_label("top_period", "1"), "top period");  // of a section, in its own time
}

TEST(PlotText, IsHtmlToo) {
  EXPECT_EQ(html_of(typeset("R_p theta_p < 1")),
            "<i>R</i><sub>p</sub> <i>θ</i><sub>p</sub> &lt; 1");
  EXPECT_EQ(quantity_html("dmf_max"), "largest meshing force");
}

}  // namespace
}  // namespace gearsweep
