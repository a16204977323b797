// Pictures over one axis: curves, bifurcation diagrams, panels above one another and studies over
// one another.
#include <gmock/gmock.h>

#include <cmath>

#include "plot/picture_test.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::PictureTest;
using gearsweep::testing::spectrum_result;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using PlotCurveTest = PictureTest;

TEST_F(PlotCurveTest, OneAxisIsACurveAndACutMakesOne) {
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

TEST_F(PlotCurveTest, PoincareIsABifurcationDiagram) {
  const std::string path = write(example_result(7, 0));
  EXPECT_THAT(script_of({.paths = {path}}), HasSubstr("\"{/:Italic x}_{1} ({/:Italic b}_{n})\""));
  EXPECT_THAT(script_of({.paths = {path}, .quantity = "poincare:v1"}),
              HasSubstr("\"{/:Italic v}_{1} ({/:Italic b}_{n}{/:Italic ϖ})\""));
  const std::string map = write(example_result());
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "poincare", .at = {{"omega", 2.0}}}),
              AllOf(HasSubstr("with points"), HasSubstr("{/:Italic ω} = 2")));
  EXPECT_THAT(refusal([&] { plotted({.paths = {map}, .quantity = "poincare"}); }),
              AllOf(HasSubstr("axes 'omega' and 'b'"), HasSubstr("cut it")));
}

// As the transparency in '#aarrggbb' of the dots.
int transparency_in(const std::string& script) {
  const std::size_t colour = script.find("linecolor rgb '#", script.find("pointtype 7"));
  return std::stoi(script.substr(colour + 16, 2), nullptr, 16);
}

// The script keeps the samples; where they are many, each is pale.
TEST_F(PlotCurveTest, ManySamplesAreShownByTheirDensity) {
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
TEST_F(PlotCurveTest, DotsOfAVectorPictureAreOneImage) {
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

TEST_F(PlotCurveTest, OverOneAxisASpectrumIsACurveForEachExponent) {
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

TEST_F(PlotCurveTest, QuantitiesOfOneAxisStandAboveOneAnother) {
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

TEST_F(PlotCurveTest, StudiesOfOneAxisLieOverOneAnother) {
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

TEST_F(PlotCurveTest, WhatDoesNotShareOneAxisIsNotLaidOver) {
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

}  // namespace
}  // namespace gearsweep
