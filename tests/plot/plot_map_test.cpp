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
      EXPECT_EQ(count_of("<image", svg), 2U) << quantity;
      // The ground of what diverged and its box in the key.
      EXPECT_LE(count_of("<polygon", svg), 2U) << quantity;
    }
  }
}

TEST_F(PlotMapTest, ClassesHaveNamesAtTheColourBar) {
  const std::string path = write(example_result());
  // Classes that do not occur take no room.
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "contact_class"}),
              AllOf(HasSubstr("(\"no impact\" 0, \"single sided\" 1, \"double sided\" 2)"),
                    Not(HasSubstr("\"wedged\""))));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "status"}), HasSubstr("\"diverged\" 1"));
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
    EXPECT_THAT(drawn({.paths = {write(line)}, .quantity = quantity}), StartsWith("\x89PNG"));
  }
}

TEST_F(PlotMapTest, AnExponentOfBothSignsIsWhiteAtZero) {
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

}  // namespace
}  // namespace gearsweep
