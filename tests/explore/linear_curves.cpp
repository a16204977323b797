#include "explore/linear_curves.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "borders/border_search.hpp"
#include "result/border_file.hpp"

namespace gearsweep::testing {
namespace {

BorderPoint orbit_at(double omega, double amplitude) {
  BorderPoint point;
  point.place = {omega, amplitude};
  const std::complex<double> swing = response(omega, amplitude);
  point.state.resize(2);
  point.state << swing.imag(), omega * swing.real();
  const std::complex<double> multiplier = linear_multiplier(omega);
  point.multipliers.resize(2);
  point.multipliers << multiplier, std::conj(multiplier);
  point.residual = 1e-12 * omega;
  return point;
}

BorderFindings linear_findings() {
  BorderFindings findings;
  findings.study = read_study(kLinear, "test.toml");
  findings.steps = 512;
  findings.ranges = {0.8, 0.3};
  BorderCurve fold;
  fold.kind = BorderKind::fold;
  for (const double omega : {0.9, 1.0, 1.1, 1.2, 1.3}) fold.points.push_back(orbit_at(omega, 0.2));
  fold.points[3].multipliers << 1.0, 1.5;
  fold.points[4].multipliers << 1.0, 1.5;
  fold.step_error = 0.125;
  BorderCurve torus;
  torus.kind = BorderKind::neimark_sacker;
  torus.period = 2;
  for (const double amplitude : {0.15, 0.3}) torus.points.push_back(orbit_at(1.4, amplitude));
  torus.points[1].multipliers[1] = std::numeric_limits<double>::quiet_NaN();
  findings.curves = {fold, torus};
  return findings;
}

}  // namespace

std::complex<double> linear_multiplier(double omega) {
  const double damping = kLinearDamping;
  const std::complex<double> rate(-0.5 * damping, std::sqrt(1.0 - 0.25 * damping * damping));
  return std::exp(rate * 2.0 * std::numbers::pi / omega);
}

std::string write_linear_curves(const Folder& folder, Damage damage) {
  BorderFindings findings = linear_findings();
  BorderPoint& point = findings.curves[0].points[1];
  if (damage == Damage::no_place) point.place[0] = std::nan("");
  if (damage == Damage::no_state) point.state[1] = std::numeric_limits<double>::infinity();
  if (damage == Damage::no_period) findings.curves[1].period = 0;
  if (damage == Damage::no_curves) findings.curves.clear();
  const std::string path = folder / "curves.nc";
  write_borders(findings, path, {});
  return path;
}

}  // namespace gearsweep::testing
