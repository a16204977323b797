// Pictures of maps: what stands on the two axes, on the colour bar and for points without a value.
#include <gmock/gmock.h>

#include "plot/picture_test.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::count_of;
using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::PictureTest;
using gearsweep::testing::spectrum_result;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using PlotMapTest = PictureTest;

TEST_F(PlotMapTest, AnEvenGridIsAnImageWithGreyForWhatDiverged) {
  const std::string script = script_of({.paths = {write(example_result())}});
  EXPECT_THAT(script, AllOf(HasSubstr("array=(4,3)"), HasSubstr("with image"),
                            HasSubstr("\"half backlash {/:Italic b} ({/:Italic b}_{n})\""),
                            HasSubstr("\"mesh frequency {/:Italic ω}/{/:Italic ϖ}\""),
                            HasSubstr("\"rms of {/:Italic x}_{1} ({/:Italic b}_{n})\""),
                            HasSubstr("diverged at 1 of 12 points")));
}

// As that of a user's own model may be.
TEST_F(PlotMapTest, AnAxisWhoseMeaningIsItsNameIsLabelledOnce) {
  SweepResult result = example_result();
  result.study.axes[1].meaning = "b";
  EXPECT_THAT(script_of({.paths = {write(result)}}),
              HasSubstr("\"{/:Italic b} ({/:Italic b}_{n})\""));
}

// Boxes that only touch would show bright seams in vector formats.
TEST_F(PlotMapTest, AnUnevenOrLogarithmicGridIsAnImageToo) {
  SweepResult result = example_result();
  result.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("array=(1000,3)"), Not(HasSubstr("boxxyerror"))));
  result.study.axes[0].logarithmic = true;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("set logscale x"), HasSubstr("array=(4,3)")));
}

// Where shapes of a vector format touch, viewers show seams; pixels of an image have none.
TEST_F(PlotMapTest, NoMapAndNoColourBarIsMadeOfShapes) {
  SweepResult even = example_result(), uneven = example_result();
  for (double& value : even.values[0]) value = 0.7;
  uneven.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
  for (const SweepResult& result : {even, uneven}) {
    for (const char* const quantity : {"x1_rms", "contact_class"}) {
      const std::string picture = in_folder("picture.svg");
      plot_files({.paths = {write(result)}, .quantity = quantity, .output_path = picture});
      const std::string svg = content(picture);
      // The map, and the bar where its classes do not stand in the key.
      const bool has_bar = std::string(quantity) == "x1_rms";
      EXPECT_EQ(count_of("<image", svg), has_bar ? 2U : 1U) << quantity;
      // The ground of what diverged, and boxes in the key: of that, and of the classes.
      EXPECT_LE(count_of("<polygon", svg), has_bar ? 2U : 5U) << quantity;
    }
  }
}

// Long names stand below the map, which then fills the page to its right end.
TEST_F(PlotMapTest, ClassesHaveNamesBelowTheMap) {
  const std::string path = write(example_result());
  // Classes that do not occur take no room and are not explained.
  PlotRequest request = {.paths = {path}, .quantity = "contact_class"};
  EXPECT_THAT(script_of(request),
              AllOf(HasSubstr("set label \"no impact\""), HasSubstr("set label \"single sided\""),
                    HasSubstr("set label \"double sided\""), HasSubstr("which flanks take part"),
                    Not(HasSubstr("wedged"))));
  request.style.size.width = 85.0;
  const std::string script = script_of(request);
  const std::size_t right = script.find("set rmargin at screen ");
  ASSERT_NE(right, std::string::npos);
  EXPECT_GT(std::stod(script.substr(right + 22)), 0.95);
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "status"}), HasSubstr("\"diverged\" 1"));
}

// With that class its explanation is there.
TEST_F(PlotMapTest, AClassThatIsShownIsExplained) {
  SweepResult result = example_result();
  result.values[1][0] = 3.0;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "contact_class"}),
              HasSubstr("wedged: b"));
}

TEST_F(PlotMapTest, AMapWithoutAnyValueIsDrawnGrey) {
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
    EXPECT_THAT(plotted({.paths = {write(line)}, .quantity = quantity}), StartsWith("\x89PNG"));
  }
}

TEST_F(PlotMapTest, AnExponentOfBothSignsIsWhiteAtZero) {
  const std::string path = write(spectrum_result());
  // Exponent 3 goes from 0 up, 4 from -0.1 to 0.01, 9 stays below zero.
  const std::string script = script_of({.paths = {path}, .quantity = "lyapunov_spectrum:4"});
  EXPECT_THAT(script, AllOf(HasSubstr("0 '#ffffff'"), HasSubstr("set cbrange [-0.1"),
                            HasSubstr("\"Lyapunov exponents 4 (1/{/:Italic τ})\"")));
  // The same blue as beside exponents above zero, which it reaches to.
  const std::string negative = script_of({.paths = {path}, .quantity = "lyapunov_spectrum:9"});
  EXPECT_THAT(negative, AllOf(HasSubstr("0 '#ffffff')"), HasSubstr(":0]"), HasSubstr("#0b2f66"),
                              Not(HasSubstr("#6b1d08"))));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "lyapunov_spectrum"}),
              HasSubstr("Lyapunov exponents 1"));
}

TEST_F(PlotMapTest, OddGridsAreDrawn) {
  EXPECT_THAT(script_of({.paths = {write(example_result(1, 1))}, .quantity = "x1_rms"}),
              HasSubstr("with image"));
  EXPECT_THAT(script_of({.paths = {write(example_result(1, 0))}, .quantity = "x1_rms"}),
              HasSubstr("set yrange"));
}

TEST_F(PlotMapTest, ABarWithPointedEndsLeavesValuesOut) {
  SweepResult result = example_result(50, 40);
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              Not(HasSubstr("polygon")));
  result.values[0][7] = 1e6;
  EXPECT_THAT(script_of({.paths = {write(result)}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("set object polygon"), HasSubstr("99.8 %")));
}

// An end is pointed where there is more, whoever chose it.
TEST_F(PlotMapTest, ARangeThatWasAskedForShowsWhatItLeavesOut) {
  PlotRequest request = {.paths = {write(example_result())}, .quantity = "x1_rms"};  // 0.1 to 23.1
  request.style.range = {0.0, 20.0};
  EXPECT_EQ(count_of("set object polygon", script_of(request)), 1U);
  request.style.range = {5.0, 20.0};
  EXPECT_EQ(count_of("set object polygon", script_of(request)), 2U);
  request.style.range = {0.0, 30.0};
  EXPECT_EQ(count_of("set object polygon", script_of(request)), 0U);
}

TEST_F(PlotMapTest, ContoursAreSeenOnAnyColourAndSayTheirLevel) {
  PlotRequest request = {.paths = {write(example_result(30, 30))}, .quantity = "x1_rms"};
  request.style.contours.levels = {50.0, 150.0};
  EXPECT_THAT(script_of(request),
              AllOf(HasSubstr("vectors nohead linewidth 3 linecolor rgb '#ffffff'"),
                    HasSubstr("linecolor rgb '#000000'"), HasSubstr("set label \"{/*0.85 50}\""),
                    HasSubstr("set label \"{/*0.85 150}\""), HasSubstr("boxed")));
}

SweepResult result_with_scales() {
  SweepResult result = example_result();
  // varpi = 1e4 rad/s, b_n = 50 um, k0 = 2e8 N/m, 3000 rpm for each unit of omega.
  result.study.scales = {1e4, 5e-5, 2e8, 3000.0};
  return result;
}

TEST_F(PlotMapTest, AGearIsInItsUnitsUnlessOthersAreAskedFor) {
  PlotRequest request = {.paths = {write(result_with_scales())}, .quantity = "x1_rms"};
  EXPECT_THAT(script_of(request), AllOf(HasSubstr("(rpm)"), HasSubstr("(µm)")));
  request.style.has_units = true;
  EXPECT_THAT(script_of(request), AllOf(Not(HasSubstr("rpm")), Not(HasSubstr("(µm)"))));
  // One without scales beside it: both are in the model's.
  EXPECT_THAT(script_of({.paths = {write(example_result(), "other.nc")}, .quantity = "x1_rms"}),
              Not(HasSubstr("rpm")));
}

}  // namespace
}  // namespace gearsweep
