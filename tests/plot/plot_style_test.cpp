// Each option of a picture's style does what it says, on the command line's table and in a file.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "plot/plot.hpp"
#include "plot/style.hpp"
#include "result/example_result.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::kProvenance;
using gearsweep::testing::spectrum_result;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

void set(const std::string& name, const std::vector<std::string>& values, PlotStyle* style) {
  for (const StyleOption& option : style_options()) {
    if (option.name == name) return option.set(values, style);
  }
  ADD_FAILURE() << "no option " << name;
}

PlotStyle style_with(const std::string& name, const std::vector<std::string>& values) {
  PlotStyle style;
  set(name, values, &style);
  return style;
}

class PlotStyleTest : public gearsweep::testing::IoTest {
 protected:
  // The script of a picture in this style.
  std::string script_of(const std::vector<std::string>& paths, const std::string& quantity,
                        const PlotStyle& style, const std::string& ending = ".png") const {
    PlotRequest request;
    request.paths = paths;
    request.quantity = quantity;
    request.output_path = in_folder("picture" + ending);
    request.script_path = in_folder("picture.gp");
    request.style = style;
    plot_files(request);
    return content(request.script_path);
  }
  std::string map_script(const std::string& name, const std::vector<std::string>& values) const {
    return script_of({write(example_result())}, "x1_rms", style_with(name, values));
  }
  std::string refused(const std::string& name, const std::vector<std::string>& values) const {
    return refusal([&] { map_script(name, values); });
  }
  std::string file_refused(const std::string& toml) const {
    std::ofstream(in_folder("thesis.toml")) << toml;
    PlotStyle style;
    return refusal([&] { read_style_file(in_folder("thesis.toml"), &style); });
  }
};

// 85 mm are 1004 pixels at 300 to the inch.
TEST_F(PlotStyleTest, SizeIsThatOfThePrint) {
  EXPECT_THAT(map_script("size", {"85x64mm"}),
              HasSubstr("pngcairo size 1004,756 font 'DejaVu Sans,8'"));
  EXPECT_THAT(map_script("size", {"8.5x6.4cm"}), HasSubstr("size 1004,756"));
  EXPECT_THAT(map_script("width", {"170mm"}),
              AllOf(HasSubstr("pngcairo size 2008,"), HasSubstr("font 'DejaVu Sans,9'")));
  EXPECT_THAT(map_script("size", {"800x600"}), HasSubstr("size 800,600"));
  EXPECT_THAT(map_script("size", {"800pxx600px"}), HasSubstr("size 800,600"));
  const std::string path = write(example_result());
  EXPECT_THAT(script_of({path}, "x1_rms", style_with("width", {"85"}), ".pdf"),
              HasSubstr("pdfcairo size 3.3465in,"));
  EXPECT_THAT(refused("size", {"85mm"}), HasSubstr("85x64mm"));
  EXPECT_THAT(refused("size", {"85mmx64px"}), HasSubstr("85x64mm"));
  EXPECT_THAT(refused("size", {"-85x64mm"}), HasSubstr("85x64mm"));
  EXPECT_THAT(refused("width", {"5mm"}), HasSubstr("between 20 and 1000 mm"));
  EXPECT_THAT(refusal([&] { script_of({path}, "x1_rms", style_with("width", {"800px"}), ".pdf"); }),
              HasSubstr("pixels are for .png and .svg"));
}

TEST_F(PlotStyleTest, PrintShowsNoMoreThanTheTitle) {
  const std::string meaning = "mean square over the recorded";
  EXPECT_THAT(map_script("log", {"false"}), HasSubstr(meaning));
  EXPECT_THAT(map_script("width", {"85mm"}),
              AllOf(Not(HasSubstr(meaning)), HasSubstr("omega x b")));
}

TEST_F(PlotStyleTest, LettersAreThoseThatWereAskedFor) {
  EXPECT_THAT(map_script("font", {"Latin Modern Roman,7.5"}),
              HasSubstr("font 'Latin Modern Roman,7.5'"));
  EXPECT_THAT(map_script("font", {",10"}), HasSubstr("font 'DejaVu Sans,10'"));
  EXPECT_THAT(refused("font", {"Sans,0"}), HasSubstr("3 to 72"));
  EXPECT_THAT(refused("font", {"x'; system 'touch pwned"}), HasSubstr("is no font"));
}

TEST_F(PlotStyleTest, TextsStandInPlaceOfTheFilesOwn) {
  EXPECT_THAT(map_script("title", {"My {own}"}),
              AllOf(HasSubstr("\"My \\\\{own\\\\}\""), Not(HasSubstr("omega x b"))));
  EXPECT_THAT(map_script("title", {""}), Not(HasSubstr("omega x b")));
  EXPECT_THAT(map_script("xlabel", {"speed"}),
              AllOf(HasSubstr("\"speed\""), Not(HasSubstr("mesh frequency"))));
  EXPECT_THAT(map_script("ylabel", {"gap"}),
              AllOf(HasSubstr("\"gap\""), Not(HasSubstr("half backlash"))));
  EXPECT_THAT(map_script("label", {"motion"}),
              AllOf(HasSubstr("\"motion\""), Not(HasSubstr("rms of"))));
  const std::string line = write(example_result(7, 0));
  const std::string two =
      script_of({line, line}, "x1_rms", style_with("legend", {"rough", "smooth"}));
  EXPECT_THAT(two, AllOf(HasSubstr("\"rough\""), HasSubstr("\"smooth\"")));
  EXPECT_THAT(refusal([&] {
                script_of({line, line}, "x1_rms", style_with("legend", {"rough"}));
              }),
              HasSubstr("1 name for 2 curves"));
  EXPECT_THAT(refused("legend", {"rough"}), HasSubstr("there is one"));
}

TEST_F(PlotStyleTest, RangesHoldForAxesAndColours) {
  EXPECT_THAT(map_script("xrange", {"0.5:1"}), HasSubstr("set xrange [0.5:1]"));
  EXPECT_THAT(map_script("yrange", {":1"}), HasSubstr(":1]"));
  EXPECT_THAT(map_script("range", {"-1:3"}), HasSubstr("set cbrange [-1:3]"));
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(script_of({line}, "x1_rms", style_with("yrange", {"0:40"})),
              HasSubstr("set yrange [0:40]"));
  EXPECT_THAT(refused("range", {"3"}), HasSubstr("MIN:MAX"));
  EXPECT_THAT(refused("range", {":"}), HasSubstr("MIN:MAX"));
  EXPECT_THAT(refused("range", {"3:1"}), HasSubstr("must be the smaller"));
  EXPECT_THAT(refused("xrange", {"70:"}), HasSubstr("nothing lies there"));
}

TEST_F(PlotStyleTest, ColourMapsHaveNames) {
  EXPECT_THAT(map_script("colormap", {"magma"}), HasSubstr("0 '#000004'"));
  EXPECT_THAT(map_script("colormap", {"gray_r"}), HasSubstr("(0 '#ffffff', 1 '#000000')"));
  EXPECT_THAT(refused("colormap", {"viridsi"}), AllOf(HasSubstr("viridis"), HasSubstr("RdBu")));
  // The middle of a diverging map is at zero.
  PlotStyle style = style_with("colormap", {"RdBu"});
  set("range", {"-1:3"}, &style);
  EXPECT_THAT(script_of({write(example_result())}, "x1_rms", style), HasSubstr("0 '#f6f7f7'"));
}

TEST_F(PlotStyleTest, LogarithmicColoursAndAxes) {
  EXPECT_THAT(map_script("log", {"true"}),
              AllOf(HasSubstr("set logscale cb"), HasSubstr("set logscale y2")));
  const std::string line = write(example_result(7, 0));
  EXPECT_THAT(script_of({line}, "x1_rms", style_with("log", {"true"})),
              HasSubstr("set logscale y\n"));
  const auto logarithmic_from_zero = [&](const std::string& name, const std::string& path) {
    PlotStyle style = style_with(name, {"0:2"});
    set("log", {"true"}, &style);
    return refusal([&] { script_of({path}, "x1_rms", style); });
  };
  EXPECT_THAT(logarithmic_from_zero("range", write(example_result(), "map.nc")),
              HasSubstr("--range: with --log its ends must be above 0"));
  EXPECT_THAT(logarithmic_from_zero("yrange", write(example_result(7, 0), "line.nc")),
              HasSubstr("--yrange: with --log its ends must be above 0"));
  SweepResult result = example_result();
  for (double& value : result.values[0]) value = -1.0;
  EXPECT_THAT(refusal([&] { script_of({write(result)}, "x1_rms", style_with("log", {"true"})); }),
              HasSubstr("no value is greater than 0"));
}

TEST_F(PlotStyleTest, ContoursAreLinesBetweenThePoints) {
  // x1_rms is 10 iy + ix + 0.1: at 5.1 a line between the first two rows.
  EXPECT_THAT(map_script("contours", {"5.1"}), HasSubstr("with vectors nohead"));
  EXPECT_THAT(map_script("contours", {"99"}), Not(HasSubstr("with vectors")));
  EXPECT_THAT(refused("contours", {"many"}), HasSubstr("give how many"));
  EXPECT_THAT(refused("contours", {"", ""}), HasSubstr("',' are no contours"));
}

TEST_F(PlotStyleTest, UnitsOfAGearAreRpmAndNewton) {
  SweepResult result = example_result();
  result.study.scales = {100.0, 5e-5, 2e8, 2000.0};
  const std::string path = write(result);
  EXPECT_THAT(script_of({path}, "x1_rms", style_with("units", {"SI"})),
              AllOf(HasSubstr("\"pinion speed (rpm)\""), HasSubstr("set cbrange [5:1155]"),
                    HasSubstr("\"half backlash {/:Italic b} (µm)\""), HasSubstr("(µm)\"")));
  EXPECT_THAT(map_script("units", {"model"}), Not(HasSubstr("rpm")));
  EXPECT_THAT(refused("units", {"SI"}), HasSubstr("[gear] table"));
  EXPECT_THAT(refused("units", {"imperial"}), HasSubstr("give SI or model"));
}

TEST_F(PlotStyleTest, LatexIncludesAPictureBesideIt) {
  SweepResult result = example_result();
  result.study.title = "50 % of $x_1$ \\input{/etc/passwd} #&~^";
  const std::string path = write(result);
  script_of({path}, "x1_rms", {}, ".tex");
  const std::string text = content(in_folder("picture.tex"));
  EXPECT_THAT(text, AllOf(HasSubstr("{picture}"), Not(HasSubstr("\\input{")),
                          HasSubstr("50 \\% of \\$x\\_1\\$ \\textbackslash{}{}input\\{/etc"),
                          HasSubstr("$\\omega$"), Not(HasSubstr(folder_.string()))));
  EXPECT_THAT(content(in_folder("picture.pdf")), StartsWith("%PDF"));
  EXPECT_THAT(refusal([&] { script_of({path}, "x1_rms", {}, "} \\input x.tex"); }),
              HasSubstr("LaTeX includes it by its name"));
  result.study.selection.quantities[1].flags = {"100%", "%d", "{c}"};
  script_of({write(result)}, "contact_class", {}, ".tex");
  EXPECT_THAT(content(in_folder("picture.tex")),
              AllOf(HasSubstr("100\\%}"), HasSubstr("\\%d}"), HasSubstr("\\{c\\}")));
  // A sweep asks before it begins.
  EXPECT_THAT(refusal([&] { ensure_plottable(in_folder("my map.tex")); }),
              HasSubstr("LaTeX includes it by its name"));
}

// A document that reads figures/kinds.tex finds figures/kinds.pdf, beside what \graphicspath says.
TEST_F(PlotStyleTest, LatexFindsThePictureOfAFolderBelow) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::create_directory(in_folder("figures"));
  const std::string path = write(example_result());
  std::filesystem::current_path(in_folder(""));
  PlotRequest request;
  request.paths = {path};
  request.quantity = "x1_rms";
  request.output_path = "figures/kinds.tex";
  plot_files(request);
  std::filesystem::current_path(before);
  const std::string text = content(in_folder("figures/kinds.tex"));
  EXPECT_THAT(text, AllOf(HasSubstr("{kinds}"), HasSubstr("{\\Ginput@path{figures/}}")));
  EXPECT_LT(text.find("\\begingroup"), text.find("Ginput@path")) << "for this picture alone";
}

TEST_F(PlotStyleTest, AFileHasTheSameKeys) {
  std::ofstream(in_folder("thesis.toml"))
      << "width = '85mm'\nfont = 'DejaVu Serif,8'\ntitle = ''\n"
         "log = true\nlegend = ['a', 'b']\ncontours = [1, 2.5]\n"
         "range = '0:2'\n";
  PlotStyle style;
  read_style_file(in_folder("thesis.toml"), &style);
  EXPECT_EQ(style.size.width, 85.0);
  EXPECT_EQ(style.font, "DejaVu Serif");
  EXPECT_EQ(style.title, "");
  EXPECT_TRUE(style.is_log);
  EXPECT_THAT(style.legend, ::testing::ElementsAre("a", "b"));
  EXPECT_THAT(style.contours.levels, ::testing::ElementsAre(1.0, 2.5));
  EXPECT_EQ(style.range.max, 2.0);
}

// 2 says how many, [2] which.
TEST_F(PlotStyleTest, AListOfOneContourIsALevel) {
  const auto contours = [&](const std::string& toml) {
    std::ofstream(in_folder("thesis.toml")) << toml;
    PlotStyle style;
    read_style_file(in_folder("thesis.toml"), &style);
    return style.contours;
  };
  EXPECT_EQ(contours("contours = 2\n").count, 2U);
  EXPECT_THAT(contours("contours = [2]\n").levels, ::testing::ElementsAre(2.0));
  EXPECT_EQ(contours("contours = [2]\n").count, 0U);
}

TEST_F(PlotStyleTest, AWrongFileIsToldByItsLine) {
  EXPECT_THAT(file_refused("\nwdith = '85mm'\n"),
              AllOf(HasSubstr("thesis.toml:2: "), HasSubstr("did you mean 'width'?")));
  EXPECT_THAT(file_refused("log = 'yes'\n"), HasSubstr("thesis.toml:1: log must be true or false"));
  EXPECT_THAT(file_refused("\n\ntitle = [1]\n"), HasSubstr("thesis.toml:3: title must be a text"));
  EXPECT_THAT(file_refused("legend = []\n"), HasSubstr("must be a list"));
  EXPECT_THAT(file_refused("width = '85 ells'\n"), HasSubstr("thesis.toml:1: width: '85 ells'"));
  EXPECT_THAT(file_refused("width = \n"), HasSubstr("thesis.toml:1: "));
  EXPECT_THAT(file_refused(std::string(100'001, '\n')), HasSubstr("too large for a style file"));
  PlotStyle style;
  EXPECT_THAT(refusal([&] { read_style_file(in_folder("none.toml"), &style); }),
              HasSubstr("none.toml"));
}

}  // namespace
}  // namespace gearsweep
