// The rules behind the verdicts, on maps made by hand: what the paper says holds in one set of
// them, and stops to hold when a number is changed.
#include "reproduce/detail/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "reproduce/detail/report.hpp"
#include "reproduce/detail/runs.hpp"
#include "study/builtin_studies.hpp"

namespace gearsweep {
namespace {

using ::testing::HasSubstr;

using Shape = std::function<double(double x)>;

// A map of the built-in study with these quantities; all others are 0.
SweepResult made_map(const std::string& figure, const std::map<std::string, Shape>& shapes) {
  SweepResult result;
  result.study = read_study(builtin_studies().at("paper/" + figure + ".toml"), figure);
  for (const Quantity& quantity : result.study.selection.quantities) {
    const auto shape = shapes.find(quantity.name);
    std::vector<double> map;
    for (const double x : result.study.axes.front().values) {
      map.push_back(shape == shapes.end() ? 0.0 : shape->second(x));
    }
    result.values.push_back(map);
  }
  result.status.assign(result.study.points(), 0);
  return result;
}

// One period of x1 between these ends, with a share of each of some orders.
Trace made_trace(double min, double max, const std::map<double, double>& orders = {}) {
  Trace trace;
  trace.period = 1.0;
  trace.channels = {{"x1", "b_n", ""}};
  trace.values.resize(1);
  for (int i = 0; i <= 6 * 2000; ++i) {
    const double t = i / 2000.0;
    double x = 0.5 * (min + max);
    if (orders.empty()) x += 0.5 * (max - min) * std::sin(2.0 * std::numbers::pi * t);
    for (const auto& [order, amplitude] : orders) {
      x += amplitude * std::sin(2.0 * std::numbers::pi * order * t);
    }
    trace.tau.push_back(t);
    trace.values[0].push_back(x);
  }
  return trace;
}

double bump(double x, double at) { return std::exp(-std::pow((x - at) / 0.02, 2)); }

// All that the paper says.
MeasuredFigures as_the_paper_says() {
  MeasuredFigures measured;
  measured.preset = "paper";
  const auto spectrum = [](double friction) {
    std::map<double, double> orders;
    for (int n = 1; n <= 12; ++n) orders[n / 6.0] = n % 3 == 0 ? 0.01 : 0.01 / (1.0 + friction);
    for (int n = 3; n <= 12; ++n) orders[n] = 0.001 / (1.0 + friction);
    return orders;
  };
  const auto rms = [](double x) { return 1.0 + bump(x, 0.25) + bump(x, 0.5); };
  measured.maps["fig4"] =
      made_map("fig4", {{"x1_rms", [&](double x) { return 1.01 * rms(x); }},
                        {"dmf_max", [](double x) { return x < 0.14 ? 1.1 : 0.9; }}});
  measured.maps["fig4-friction"] =
      made_map("fig4-friction", {{"x1_rms", rms}, {"dmf_max", [](double) { return 1.0; }}});
  for (const double friction : {0.0, 1.0}) {
    std::map<double, double> orders = {{1.0, 0.001}, {2.0, 0.001}, {7.0, 0.0005 / (1 + friction)}};
    for (const double order : {6.0, 8.0, 9.0, 10.0, 11.0, 12.0}) orders[order] = 1e-4;
    measured.traces["fig5"].push_back(made_trace(0.935, 0.94, orders));
    measured.traces["fig6"].push_back(made_trace(0.0, 1.0, spectrum(friction)));
  }
  measured.maps["fig7"] = made_map(
      "fig7", {{"dmf_max", [](double b) { return b < 0.5 ? 0.22 : 1.0; }},
               {"x1_rms", [](double b) { return b; }},
               {"contact_class", [](double b) { return b < 0.5   ? 0.0
                                                       : b < 0.6 ? 1.0
                                                                 : 2.0; }},
               {"lyapunov_max", [](double b) { return b < 0.5 ? -0.01 : 0.05; }}});
  measured.jumps["fig7"] = {{.below = 0.4975, .above = 0.5, .count_below = 1, .count_above = 1}};
  measured.traces["fig8"] = {made_trace(0.2, 0.4), made_trace(-1.0, 2.0), made_trace(-1.0, 2.0),
                             made_trace(-7.0, 7.0)};
  measured.traces["fig8-late"] = {made_trace(0.25, 0.35)};
  measured.maps["fig8"] = made_map("fig8", {{"dmf_min", [](double) { return -1.0; }},
                                            {"lyapunov_max", [](double) { return 0.05; }}});
  for (const char* figure : {"fig9", "fig9-dynamic"}) {
    const double onset = std::string(figure) == "fig9" ? 0.7 : 0.6;
    measured.maps[figure] = made_map(
        figure, {{"lyapunov_max", [onset](double x) { return x < onset ? -0.01 : 0.05; }}});
  }
  measured.maps["fig10"] = made_map(
      "fig10", {{"dmf_max", [](double) { return 0.22; }},
                {"x1_rms", [](double b) { return b; }},
                {"lyapunov_max", [](double b) { return std::fmod(b, 0.2) < 0.1 ? -0.01 : 0.05; }}});
  return measured;
}

Verdict verdict_on(const MeasuredFigures& measured, int figure, std::size_t number) {
  for (const Judgement& judgement : judge(measured)) {
    if (judgement.figure == figure && number-- == 0) return judgement.verdict;
  }
  throw std::logic_error("no such claim");
}

TEST(Claims, AllHoldWhereAllIsAsThePaperSays) {
  for (const Judgement& judgement : judge(as_the_paper_says())) {
    EXPECT_EQ(name_of(judgement.verdict), "holds") << judgement.claim << ' ' << judgement.measured;
    EXPECT_FALSE(judgement.rule.empty());
  }
}

TEST(Claims, AResonanceElsewhereHoldsInPart) {
  MeasuredFigures measured = as_the_paper_says();
  measured.maps["fig4"] =
      made_map("fig4", {{"x1_rms", [](double x) { return 1.0 + bump(x, 0.25) + bump(x, 0.57); }}});
  EXPECT_EQ(verdict_on(measured, 4, 0), Verdict::in_part);
}

TEST(Claims, CoexistenceOnBothSidesIsNoBifurcation) {
  MeasuredFigures measured = as_the_paper_says();
  measured.jumps["fig7"] = {{.below = 0.4975, .above = 0.5, .count_below = 2, .count_above = 2}};
  EXPECT_EQ(verdict_on(measured, 7, 1), Verdict::holds);
  EXPECT_EQ(verdict_on(measured, 7, 2), Verdict::does_not_hold);
}

TEST(Claims, WithoutAJumpNeitherItNorItsKindHolds) {
  MeasuredFigures measured = as_the_paper_says();
  measured.jumps.clear();
  EXPECT_EQ(verdict_on(measured, 7, 1), Verdict::does_not_hold);
  EXPECT_EQ(verdict_on(measured, 7, 2), Verdict::does_not_hold);
}

TEST(Claims, ChaosOfTheDynamicBacklashMustComeEarlier) {
  MeasuredFigures measured = as_the_paper_says();
  std::swap(measured.maps["fig9"].values, measured.maps["fig9-dynamic"].values);
  EXPECT_EQ(verdict_on(measured, 9, 0), Verdict::in_part);
}

TEST(Claims, AMissingRegimeOfContactHoldsInPart) {
  MeasuredFigures measured = as_the_paper_says();
  measured.maps["fig7"] = made_map(
      "fig7", {{"dmf_max", [](double) { return 0.22; }}, {"x1_rms", [](double b) { return b; }}});
  EXPECT_EQ(verdict_on(measured, 11, 0), Verdict::in_part);
}

// A reader who finds two colours in a picture and four in the table asks why.
TEST(Report, SaysWhyAPictureShowsFewerAttractorsThanTheTableCounts) {
  MeasuredFigures measured = as_the_paper_says();
  measured.jumps["fig7"] = {{.below = 0.4325, .above = 0.435, .count_below = 3, .count_above = 4}};
  measured.basins = {{"fig7", 0.4325, 2, 3}, {"fig7", 0.435, 2, 4}};
  const std::string text = describe_jumps(measured);
  EXPECT_THAT(text, HasSubstr("| 7 | 0.4325 | 0.4350 | 3 | 4 | change of basin |"));
  EXPECT_THAT(text, HasSubstr("x1 and v1 vary"));
  EXPECT_THAT(text, HasSubstr("figure 7, b = 0.4325: 2 in the picture, 3 in the table"));
  EXPECT_THAT(text, HasSubstr("figure 7, b = 0.4350: 2 in the picture, 4 in the table"));
}

TEST(Figures, AreBuiltInForBothPresets) {
  for (const std::string& name : figure_names()) {
    for (const std::string preset : {"paper", "consistent"}) {
      const Study study = read_study(builtin_studies().at(preset + "/" + name + ".toml"), name);
      EXPECT_EQ(study.preset, preset);
      EXPECT_EQ(study.axes.size(), 1U);
    }
  }
}

}  // namespace
}  // namespace gearsweep
