// Pictures in general: formats, locales, scripts that are kept, and what is refused.
#include <gmock/gmock.h>

#include <cstdlib>
#include <optional>
#include <set>

#include "plot/detail/gnuplot.hpp"
#include "plot/picture_test.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::PictureTest;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using PlotTest = PictureTest;

TEST_F(PlotTest, TheEndingChoosesTheFormat) {
  const std::string path = write(example_result());
  EXPECT_THAT(plotted({.paths = {path}, .quantity = "x1_rms"}, ".png"), StartsWith("\x89PNG"));
  EXPECT_THAT(plotted({.paths = {path}, .quantity = "x1_rms"}, ".pdf"), StartsWith("%PDF"));
  EXPECT_THAT(plotted({.paths = {path}, .quantity = "x1_rms"}, ".svg"), HasSubstr("<svg"));
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

// Who restyles a script draws other data with it.
TEST_F(PlotTest, AKeptScriptTakesPictureAndData) {
  script_of({.paths = {write(example_result())}, .quantity = "x1_rms"});
  fs::rename(in_folder("picture.dat"), in_folder("other.dat"));
  const std::string command = "cd '" + folder_.string() + "' && gnuplot -c picture.gp again.png";
  EXPECT_NE(std::system((command + " 2> said.txt").c_str()), 0);
  EXPECT_EQ(std::system((command + " other.dat").c_str()), 0);
  EXPECT_THAT(content(in_folder("again.png")), StartsWith("\x89PNG"));
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

}  // namespace
}  // namespace gearsweep
