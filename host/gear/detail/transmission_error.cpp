#include "gear/detail/transmission_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "gear/detail/measured_curve.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMostHarmonics = 8;

// The mean square of what is not the mean.
double power_of(const MeasuredCurve& curve) {
  constexpr int kSamples = 4096;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSamples;
    sum += std::pow(curve.table->at(angle, angle) - curve.mean, 2) / kSamples;
  }
  return sum;
}

// A second derivative enters: a curve that jumps has none.
std::vector<Harmonic> measured_error(const GearDrawing& drawing, const MeasuredCurve& curve,
                                     GearTarget* target) {
  if (drawing.has(kTransmissionError) || drawing.has(kErrorPhase)) {
    throw DrawingError(
        kErrorFile,
        "transmission_error_file and transmission_error_um both give the error; keep one");
  }
  if (!curve.table->jumps().empty()) {
    throw DrawingError(kErrorFile, "a transmission error that jumps has no second derivative");
  }
  const auto value = [&](double angle) { return curve.table->at(angle, angle); };
  const std::vector<Harmonic> harmonics = harmonics_of(value, kMostHarmonics);
  const double all = power_of(curve);
  double left = all;
  for (const Harmonic& harmonic : harmonics) left -= 0.5 * harmonic.amplitude * harmonic.amplitude;
  target->note(fmt::format(
      "transmission error: the first {} harmonics of '{}'; they leave out {:.3g} % of its power",
      harmonics.size(), curve.table->name(), all > 0.0 ? 100.0 * std::fmax(0.0, left) / all : 0.0));
  return harmonics;
}

std::vector<Harmonic> given_error(const GearDrawing& drawing) {
  const std::vector<double>& amplitudes = drawing.list(kTransmissionError);
  const std::vector<double> phases = drawing.numbers(kErrorPhase);
  if (amplitudes.empty() || amplitudes.size() > kMostHarmonics) {
    throw DrawingError(kTransmissionError,
                       fmt::format("{} has {} numbers; 1 to {} is possible",
                                   kTransmissionError.name, amplitudes.size(), kMostHarmonics));
  }
  if (phases.size() > amplitudes.size()) {
    throw DrawingError(
        kErrorPhase,
        fmt::format("{} has {} numbers; at most one for each harmonic of the error is possible",
                    kErrorPhase.name, phases.size()));
  }
  std::vector<Harmonic> harmonics;
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const double degrees = i < phases.size() ? phases[i] : 0.0;
    harmonics.push_back({amplitudes[i], degrees * std::numbers::pi / 180.0});
  }
  return harmonics;
}

// What the deviations of the pairs in contact add to the error: their mean by the load that each
// carries, which is shared as the parabolic stiffness has it.
std::vector<Harmonic> profile_error(const std::vector<TablePoint>& removed, double eps) {
  return harmonics_of(
      [&](double angle) {
        double sum = 0.0, load = 0.0;
        for (double s = angle / (2.0 * std::numbers::pi); s < eps; s += 1.0) {
          const double offset = 2.0 * s / eps - 1.0;
          const double share = 1.0 - kParabolicFall * offset * offset;
          sum += share * value_over_path(removed, s / eps);
          load += share;
        }
        return sum / load;
      },
      kMostHarmonics);
}

// a sin(x + p) is the imaginary part of a e^(ip) e^(ix).
std::vector<Harmonic> sum_of(std::vector<Harmonic> one, const std::vector<Harmonic>& other) {
  one.resize(std::max(one.size(), other.size()));
  for (std::size_t i = 0; i < other.size(); ++i) {
    const std::complex<double> sum =
        std::polar(one[i].amplitude, one[i].phase) + std::polar(other[i].amplitude, other[i].phase);
    one[i] = {std::abs(sum), std::arg(sum)};
  }
  return one;
}

}  // namespace

bool add_transmission_error(const GearDrawing& drawing, const GearGeometry& geometry,
                            const ContactPath& path, double b_n, GearTarget* target) {
  if (!target->takes(kTransmissionError)) return true;
  const std::optional<MeasuredCurve> measured =
      measured_curve(drawing, kErrorFile, Interpolation::cubic);
  std::vector<Harmonic> series =
      measured ? measured_error(drawing, *measured, target) : given_error(drawing);
  const Measured* removed = drawing.measured(kProfileFile);
  if (removed != nullptr) {
    if (geometry.helix > 0.0) {
      throw DrawingError(kProfileFile, "profile_deviation_file is for spur gears");
    }
    series = sum_of(std::move(series), profile_error(removed->points, path.contact_ratio()));
    target->note(
        fmt::format("transmission error: with the first {} harmonics of what the "
                    "profile's deviations add",
                    kMostHarmonics));
  }
  const GearKey& origin = measured ? kErrorFile : kTransmissionError;
  const bool has_phases = measured || removed != nullptr || drawing.has(kErrorPhase);
  const GearKey& phase_origin = drawing.has(kErrorPhase) ? kErrorPhase : origin;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = series[i].amplitude * 1e-6;
    target->add("e0", error / b_n, origin, fmt::format("e/b_n = {:.6g} m / {:.6g} m", error, b_n),
                i);
    if (!has_phases) continue;
    target->add("e0_phase", series[i].phase, phase_origin,
                fmt::format("{:.6g} degrees", series[i].phase * 180.0 / std::numbers::pi), i);
  }
  return series.size() == 1;
}

}  // namespace gearsweep
