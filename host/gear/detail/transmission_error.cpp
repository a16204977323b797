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
  target->note(
      "transmission error: the first {} harmonics of '{}'; they leave out {:.3g} % of its power",
      harmonics.size(), curve.table->name(), all > 0.0 ? 100.0 * std::fmax(0.0, left) / all : 0.0);
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

// What is carried along the path of contact of a pair, and what is taken away there. The load is
// shared as the parabolic stiffness has it.
class CarriedPath {
 public:
  struct Sums {
    double load = 0.0, removed = 0.0;
  };

  // removed: over the path, 0 to 1; eps: its length in base pitches.
  CarriedPath(const std::vector<TablePoint>& removed, double eps) : removed_(removed), eps_(eps) {
    ends_ = {0.0};
    for (const TablePoint& point : removed) {
      const double end = point.phase * eps;
      if (end > ends_.back() && end < eps) ends_.push_back(end);
    }
    sums_ = {{}};
    for (std::size_t i = 1; i < ends_.size(); ++i) sums_.push_back(from_end(i - 1, ends_[i]));
  }

  double length() const { return eps_; }

  // At a place, in base pitches from where contact begins.
  Sums at(double place) const {
    const double offset = 2.0 * place / eps_ - 1.0;
    const double load = 1.0 - kParabolicFall * offset * offset;
    return {load, load * value_over_path(removed_, place / eps_)};
  }

  // The integral up to a place; there is no load before the path and behind it.
  Sums until(double place) const {
    const double end = std::clamp(place, 0.0, eps_);
    const auto after = std::ranges::upper_bound(ends_, end);
    return from_end(static_cast<std::size_t>(after - ends_.begin()) - 1, end);
  }

 private:
  // The load is a parabola, and lines are between the ends: Gauss's two points are right.
  Sums from_end(std::size_t i, double to) const {
    const double half = 0.5 * (to - ends_[i]), middle = ends_[i] + half;
    const Sums first = at(middle - half / std::sqrt(3.0)),
               second = at(middle + half / std::sqrt(3.0));
    return {sums_[i].load + half * (first.load + second.load),
            sums_[i].removed + half * (first.removed + second.removed)};
  }

  const std::vector<TablePoint>& removed_;
  double eps_;
  std::vector<double> ends_;  // where the lines of `removed` begin
  std::vector<Sums> sums_;    // until there
};

// What the deviations of the pairs in contact add to the error: their mean by the load that each
// carries. Of helical teeth the slices of a pair are spread over `overlap` base pitches, and each
// has the deviation of its own place.
std::vector<Harmonic> profile_error(const CarriedPath& path, double overlap) {
  return harmonics_of(
      [&](double angle) {
        CarriedPath::Sums all;
        for (double s = angle / (2.0 * std::numbers::pi); s < path.length() + overlap; s += 1.0) {
          const CarriedPath::Sums to = overlap > 0.0 ? path.until(s) : path.at(s);
          const CarriedPath::Sums from =
              overlap > 0.0 ? path.until(s - overlap) : CarriedPath::Sums();
          all.load += to.load - from.load;
          all.removed += to.removed - from.removed;
        }
        return all.removed / all.load;
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
    const double overlap =
        geometry.helix > 0.0 ? geometry.overlap(drawing.required(kFaceWidth)) : 0.0;
    const CarriedPath carried(removed->points, path.contact_ratio());
    series = sum_of(std::move(series), profile_error(carried, overlap));
    target->note(
        "transmission error: with the first {} harmonics of what the profile's deviations add{}",
        kMostHarmonics, overlap > 0.0 ? ", slice by slice along the helix" : "");
  }
  const GearKey& origin = measured ? kErrorFile : kTransmissionError;
  const bool has_phases = measured || removed != nullptr || drawing.has(kErrorPhase);
  const GearKey& phase_origin = drawing.has(kErrorPhase) ? kErrorPhase : origin;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = series[i].amplitude * 1e-6;
    target->add_to_list("e0", i, error / b_n, origin, "e/b_n = {:.6g} m / {:.6g} m", error, b_n);
    if (!has_phases) continue;
    target->add_to_list("e0_phase", i, series[i].phase, phase_origin, "{:.6g} degrees",
                        series[i].phase * 180.0 / std::numbers::pi);
  }
  return series.size() == 1;
}

}  // namespace gearsweep
