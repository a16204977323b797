// The borders of a computed map: their curves, and what parts all other pairs of pixels.
#include "borders/border_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "borders/curve_distance.hpp"
#include "borders/curve_numbers.hpp"
#include "borders/host_orbit_map.hpp"
#include "model/error.hpp"
#include "orbits/floquet.hpp"
#include "study/study.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::testing {
namespace {

// Flips, folds and tori of the coarse gear, whose teeth part and meet on both flanks.
constexpr const char* kCoarse = R"(
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 1.3
to = 1.45
count = 20
[[axes]]
name = "b"
from = 0.48
to = 0.62
count = 20
[integrate]
max_step = 0.1
states = "all"
[observe]
quantities = ["period"]
)";

struct Searched {
  PeriodPixels pixels;
  BorderFindings findings;
};

Searched search(const std::string& toml, std::size_t min_edges) {
  const SweepResult result = run_sweep(read_study(toml, "study"), {}).value();
  BorderRequest request;
  for (std::size_t i = 0; i < 2; ++i) request.pixels.axes[i] = result.study.axes[i].values;
  request.pixels.period = map_of(result, "period");
  request.min_edges = min_edges;
  return {request.pixels, find_borders(result.study, request, {}).value()};
}

class BorderSearchOfAGear : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { searched_ = std::make_unique<Searched>(search(kCoarse, 6)); }
  static void TearDownTestSuite() { searched_.reset(); }
  static std::unique_ptr<Searched> searched_;
};
std::unique_ptr<Searched> BorderSearchOfAGear::searched_;

// The engine corrects steps that cross a limit of the backlash; the host cuts them there, and takes
// four times as many. With 512 steps they were 1.4e-7 of a window apart where it was looked at,
// with 256 some sixteen times that. 2e-6 must do.
TEST_F(BorderSearchOfAGear, CurvesOfTheEngineAreThoseOfTheHost) {
  const BorderFindings& findings = searched_->findings;
  ASSERT_GE(findings.curves.size(), 2U);
  ParameterPlane plane{findings.study.model, findings.study.setting, {}, {1.3, 0.48}, {1.45, 0.62}};
  for (std::size_t i = 0; i < 2; ++i) plane.parameters[i] = findings.study.axes[i].index;
  HostOrbitMap host(plane, 1024);
  for (std::size_t i = 0; i < 2; ++i) {
    const BorderCurve& curve = findings.curves[i];
    const BorderPoint& point = curve.points[curve.points.size() / 2];
    const auto image = host.map_at(point.place).linearize(point.state, curve.period);
    const BorderEquations equations(plane, &host, curve.kind, curve.period,
                                    {sizes_of(*image), {plane.range(0), plane.range(1)}});
    const auto found =
        equations.correct(equations.unknowns_of(point), point.tangent, point.critical, 0.1);
    ASSERT_TRUE(found) << name_of(curve.kind);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(found->place[k], point.place[k], 2e-6 * plane.range(k)) << name_of(curve.kind);
    }
  }
}

TEST_F(BorderSearchOfAGear, ACurveThatExplainsAPairPassesBetweenThem) {
  std::size_t explained = 0, all = 0;
  for (const ExplainedBorder& border : searched_->findings.borders) {
    all += border.reasons.size();
    explained += border.count(EdgeReason::curve);
    for (std::size_t i = 0; i < border.reasons.size(); ++i) {
      if (border.reasons[i] != EdgeReason::curve) continue;
      const PixelPlace middle = middle_of(searched_->pixels, border.border.edges[i]);
      double nearest = 10.0;
      for (const BorderCurve& curve : searched_->findings.curves) {
        nearest = std::min(nearest, PixelLine(searched_->pixels, curve).distance_to(middle, true));
      }
      EXPECT_LE(nearest, 0.5);
    }
  }
  EXPECT_GT(2 * explained, all);
}

TEST_F(BorderSearchOfAGear, ResidualsAreSmallAndMultipliersOnTheCircle) {
  for (const BorderCurve& curve : searched_->findings.curves) {
    EXPECT_LE(curve.max_residual(), 1e-8);
    for (const BorderPoint& point : curve.points) {
      const std::complex<double> critical = std::polar(1.0, point.angle);
      double nearest = 10.0;
      for (const std::complex<double>& m : point.multipliers) {
        nearest = std::min(nearest, std::abs(m - critical));
      }
      EXPECT_LT(nearest, 1e-4) << name_of(curve.kind);
    }
  }
}

// Threads are not equally fast each time. The curves do not depend on that, nor does their order.
TEST_F(BorderSearchOfAGear, FindsTheSameBitsAgain) {
  const std::vector<double> first = numbers_of(searched_->findings.curves),
                            second = numbers_of(search(kCoarse, 6).findings.curves);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
}

TEST_F(BorderSearchOfAGear, CurvesAreTheSameAfterTheyWereKept) {
  const std::vector<double> kept = numbers_of(searched_->findings.curves);
  const std::vector<BorderCurve> read = curves_of(kept);
  ASSERT_EQ(read.size(), searched_->findings.curves.size());
  const BorderCurve &a = read.back(), &b = searched_->findings.curves.back();
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.points.back().state, b.points.back().state);
  EXPECT_EQ(a.points.back().multipliers, b.points.back().multipliers);
  EXPECT_EQ(a.points[a.start].place, b.points[b.start].place);
  EXPECT_EQ(a.step_error, b.step_error);
  EXPECT_THROW(curves_of(std::span(kept).first(kept.size() - 1)), InputError);
  EXPECT_THROW(curves_of(std::vector<double>{-1.0}), InputError);
  EXPECT_THROW(curves_of(std::vector<double>{1e7}), InputError);  // a count without its curves
  std::vector<double> of_no_kind = kept;
  of_no_kind[1] = 99.0;
  EXPECT_THROW(curves_of(of_no_kind), InputError);
  EXPECT_THROW(curves_of(std::vector<double>{std::nan("")}), InputError);
}

// The only motion of a linear oscillator is stable everywhere. A map that shows it in one half
// alone has a border without a bifurcation; one that gives it three periods shows no motion of its
// own.
constexpr const char* kLinear = R"(
[model]
name = "duffing"
[parameters]
damping = 0.2
linear = 1.0
cubic = 0.0
[[axes]]
name = "omega"
from = 0.5
to = 2.0
count = 6
[[axes]]
name = "amplitude"
from = 0.5
to = 1.0
count = 4
[observe]
quantities = ["period"]
)";

ExplainedBorder only_border_of_linear(double left_period) {
  const Study study = read_study(kLinear, "study", {"integrate.tolerance=0"});
  BorderRequest request;
  for (std::size_t i = 0; i < 2; ++i) request.pixels.axes[i] = study.axes[i].values;
  for (std::size_t pixel = 0; pixel < 24; ++pixel) {
    request.pixels.period.push_back(pixel % 6 < 3 ? left_period : std::nan(""));
  }
  request.min_edges = 2;
  const BorderFindings findings = find_borders(study, request, {}).value();
  EXPECT_TRUE(findings.curves.empty());
  EXPECT_EQ(findings.borders.size(), 1U);
  return findings.borders.front();
}

TEST(BorderSearch, AMotionThatGoesOnHasNoBifurcationThere) {
  EXPECT_EQ(only_border_of_linear(1.0).count(EdgeReason::basin), 4U);
}

TEST(BorderSearch, AMotionOfAnotherPeriodIsNotTheOneThatTheMapShows) {
  EXPECT_EQ(only_border_of_linear(3.0).count(EdgeReason::unsettled), 4U);
}

TEST(BorderSearch, RefusesAMapOfOneAxisAndOfStates) {
  const std::string head =
      "[model]\nname = \"duffing\"\n[[axes]]\nname = \"omega\"\nfrom = 1\nto = 2\ncount = 3\n";
  const Study line = read_study(head, "study");
  EXPECT_THROW(find_borders(line, {}, {}), InputError);
  const Study basin =
      read_study(head + "[[axes]]\nname = \"x\"\nfrom = 0\nto = 1\ncount = 3\n", "study");
  EXPECT_THROW(find_borders(basin, {}, {}), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
