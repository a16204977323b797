// The borders of a computed map: their curves, and what parts all other pairs of pixels.
#include "borders/border_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "borders/host_orbit_map.hpp"
#include "orbits/floquet.hpp"
#include "study/study.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::testing {
namespace {

PeriodPixels pixels_of(const SweepResult& result) {
  PeriodPixels pixels;
  for (std::size_t i = 0; i < 2; ++i) pixels.axes[i] = result.study.axes[i].values;
  pixels.period = map_of(result, "period");
  return pixels;
}

BorderFindings findings_of(const std::string& toml) {
  const Study study = read_study(toml, "study");
  const SweepResult result = run_sweep(study, {}).value();
  BorderRequest request;
  request.pixels = pixels_of(result);
  return find_borders(study, request, {}).value();
}

// Flips, folds and tori of the coarse gear, whose teeth part and meet on both flanks.
constexpr const char* kCoarse = R"(
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 1.1
to = 1.45
count = 40
[[axes]]
name = "b"
from = 0.45
to = 0.8
count = 40
[integrate]
max_step = 0.1
states = "all"
[observe]
quantities = ["period"]
)";

// The engine corrects steps that cross a limit of the backlash; the host cuts them there.
TEST(BorderSearch, CurvesOfTheEngineAreThoseOfTheHost) {
  const BorderFindings findings = findings_of(kCoarse);
  ASSERT_GE(findings.curves.size(), 4U);
  ParameterPlane plane{findings.study.model, findings.study.setting, {}, {1.1, 0.45}, {1.45, 0.8}};
  for (std::size_t i = 0; i < 2; ++i) plane.parameters[i] = findings.study.axes[i].index;
  HostOrbitMap host(plane, 2048);
  for (const BorderCurve& curve : findings.curves) {
    const BorderPoint& point = curve.points[curve.points.size() / 2];
    const HostOrbitMap sizes_map(plane, 256);
    const auto image = sizes_map.map_at(point.place).linearize(point.state, curve.period);
    const BorderEquations equations(plane, &host, curve.kind, curve.period,
                                    {sizes_of(*image), {plane.range(0), plane.range(1)}});
    const Eigen::VectorXd guess = equations.unknowns_of(point);
    const auto found = equations.correct(guess, point.tangent, point.null_vectors, 0.1);
    if (!found) { printf("%s %zu NOT FOUND\n", name_of(curve.kind).c_str(), curve.period); continue; }
    printf("%s %zu  %.2g %.2g  res %.2g\n", name_of(curve.kind).c_str(), curve.period,
           (found->place[0] - point.place[0]) / plane.range(0),
           (found->place[1] - point.place[1]) / plane.range(1), point.residual);
  }
}

}  // namespace
}  // namespace gearsweep::testing
