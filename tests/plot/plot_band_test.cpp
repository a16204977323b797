// The band of tolerances around a curve.
#include <gmock/gmock.h>

#include "plot/band.hpp"
#include "plot/picture_test.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::count_of;
using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::PictureTest;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using PlotBandTest = PictureTest;

constexpr const char* kFilled = "with filledcurves";

// The example with percentiles of x1_rms: the value itself, and so much below and above it.
SweepResult tolerant_result(std::size_t nx = 7, std::size_t ny = 0) {
  SweepResult result = example_result(nx, ny);
  for (const auto& [ending, offset] :
       {std::pair("_p2_5", -100.0), std::pair("_p50", 0.0), std::pair("_p97_5", 300.0)}) {
    Quantity quantity = result.study.selection.quantities.front();
    quantity.name += ending;
    result.study.selection.quantities.push_back(quantity);
    std::vector<double> values = result.values.front();
    for (double& value : values) value += offset;
    result.values.push_back(values);
  }
  return result;
}

TEST(BandMaps, AreTheOutermostPercentilesAndTheMedian) {
  const std::vector<std::string> names = {"f_max",     "f_max_p50", "f_max_p5",  "f_max_p99_5",
                                          "f_max_p95", "f_p_max",   "f_max_std", "g_p5"};
  const std::optional<BandMaps> maps = band_maps("f_max", names);
  ASSERT_TRUE(maps);
  EXPECT_EQ(maps->low, "f_max_p5");
  EXPECT_EQ(maps->median, "f_max_p50");
  EXPECT_EQ(maps->high, "f_max_p99_5");
  EXPECT_EQ(maps->meaning, "percentiles 5 to 99.5");
  EXPECT_EQ(band_maps("f_max", {"f_max_p10", "f_max_p90"})->median, "");
  // One percentile alone is no band; what is no number is no percentile.
  EXPECT_FALSE(band_maps("g", names));
  EXPECT_FALSE(band_maps("f", {"f_p_max", "f_p", "f_p101", "f_p05", "f_p5", "f_p-1"}));
}

TEST_F(PlotBandTest, IsDrawnByItselfAroundACurve) {
  const std::string script = script_of({.paths = {write(tolerant_result())}, .quantity = "x1_rms"});
  EXPECT_THAT(script, AllOf(HasSubstr(kFilled), HasSubstr("set label \"nominal\""),
                            HasSubstr("set label \"percentiles 2.5 to 97.5\""),
                            HasSubstr("set label \"median\"")));
  // Band, median, curve: what comes later lies over what came before.
  EXPECT_LT(script.find(kFilled), script.find("using 1:4 with lines"));
  EXPECT_LT(script.find("using 1:4 with lines"), script.find("linespoints"));
  // The axis has room for all of it.
  const std::string range = script.substr(script.find("set yrange [") + 12, 40);
  EXPECT_LT(std::stod(range), -99.0);
  EXPECT_GT(std::stod(range.substr(range.find(':') + 1)), 306.0);
}

TEST_F(PlotBandTest, CanBeLeftOut) {
  PlotRequest request = {.paths = {write(tolerant_result())}, .quantity = "x1_rms"};
  request.style.has_band = false;
  EXPECT_THAT(script_of(request), AllOf(Not(HasSubstr(kFilled)), Not(HasSubstr("nominal"))));
}

TEST_F(PlotBandTest, IsOfACurveAlone) {
  const std::string path = write(tolerant_result());
  for (const char* quantity : {"x1_rms_p50", "contact_class", "poincare"}) {
    EXPECT_THAT(script_of({.paths = {path}, .quantity = quantity}), Not(HasSubstr(kFilled)))
        << quantity;
  }
  const std::string other = write(tolerant_result(), "other.nc");
  EXPECT_THAT(script_of({.paths = {path, other}, .quantity = "x1_rms"}), Not(HasSubstr(kFilled)));
  const std::string map = write(tolerant_result(4, 3), "two.nc");
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "x1_rms"}), Not(HasSubstr(kFilled)));
  EXPECT_THAT(script_of({.paths = {map}, .quantity = "x1_rms", .at = {{"b", 1.5}}}),
              HasSubstr(kFilled));
  const std::string stack = script_of({.paths = {path}, .quantity = "x1_rms,contact_class"});
  EXPECT_EQ(count_of(kFilled, stack), 1U);
  EXPECT_EQ(count_of("set label \"median\"", stack), 1U);
}

TEST_F(PlotBandTest, WhoAsksForOneWhereThereIsNoneIsTold) {
  PlotRequest request = {.paths = {write(tolerant_result(4, 3))}, .quantity = "x1_rms"};
  request.style.demanded.insert("band");
  EXPECT_THAT(refusal([&] { plotted(request); }),
              AllOf(HasSubstr("--band"), HasSubstr("[uncertain]")));
  request.at = {{"b", 1.5}};
  EXPECT_EQ(refusal([&] { plotted(request); }), "accepted");
}

// Values at which all draws diverged are a gap in the band; on a logarithmic axis it goes down to
// the axis's end.
TEST_F(PlotBandTest, HasGapsAndLogarithmicAxes) {
  SweepResult result = tolerant_result();
  for (std::size_t i = 2; i < result.values.size(); ++i) result.values[i][2] = kNaN;
  PlotRequest request = {.paths = {write(result)}, .quantity = "x1_rms"};
  request.style.is_log = true;
  EXPECT_THAT(script_of(request), AllOf(HasSubstr(kFilled), HasSubstr("set logscale y")));
}

TEST_F(PlotBandTest, OneValueHasABar) {
  EXPECT_THAT(script_of({.paths = {write(tolerant_result(1))}, .quantity = "x1_rms"}),
              AllOf(HasSubstr("with vectors nohead"), Not(HasSubstr(kFilled))));
}

}  // namespace
}  // namespace gearsweep
