#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>

#include "study/detail/definition_entries.hpp"
#include "study/detail/gear_parts.hpp"

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
std::vector<Harmonic> measured_error(GearReader& in, const MeasuredCurve& curve,
                                     std::vector<std::string>* notes) {
  if (in.has(kTransmissionError) || in.has(kErrorPhase)) {
    fail_at(in.node(kErrorFile),
            "transmission_error_file and transmission_error_um both give the error; keep one");
  }
  if (!curve.table->jumps().empty()) {
    fail_at(in.node(kErrorFile), "a transmission error that jumps has no second derivative");
  }
  const auto value = [&](double angle) { return curve.table->at(angle, angle); };
  const std::vector<Harmonic> harmonics = harmonics_of(value, kMostHarmonics);
  const double all = power_of(curve);
  double left = all;
  for (const Harmonic& harmonic : harmonics) left -= 0.5 * harmonic.amplitude * harmonic.amplitude;
  notes->push_back(fmt::format(
      "transmission error: the first {} harmonics of '{}'; they leave out {:.3g} % of its power",
      harmonics.size(), curve.table->name(), all > 0.0 ? 100.0 * std::fmax(0.0, left) / all : 0.0));
  return harmonics;
}

std::vector<Harmonic> given_error(GearReader& in) {
  if (!in.has(kTransmissionError)) in.required(kTransmissionError);
  const std::vector<double> amplitudes = in.numbers(kTransmissionError);
  const std::vector<double> phases = in.numbers(kErrorPhase);
  if (amplitudes.empty() || amplitudes.size() > kMostHarmonics) {
    fail_at(in.node(kTransmissionError),
            fmt::format("{} has {} numbers; 1 to {} is possible", kTransmissionError.name,
                        amplitudes.size(), kMostHarmonics));
  }
  if (phases.size() > amplitudes.size()) {
    fail_at(in.node(kErrorPhase),
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
  const Model& model = gear_table_model();
  const double fall =
      model.parameters[static_cast<std::size_t>(model.find_parameter("q"))].default_value;
  return harmonics_of(
      [&](double angle) {
        double sum = 0.0, load = 0.0;
        for (double s = angle / (2.0 * std::numbers::pi); s < eps; s += 1.0) {
          const double offset = 2.0 * s / eps - 1.0;
          const double share = 1.0 - fall * offset * offset;
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

// A spline through the errors of the teeth, where each enters, and its second derivative.
void add_pitch_errors(const std::string& gear, const std::vector<double>& errors,
                      const GearBases& bases, Curves* curves) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<TablePoint> points;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    points.push_back({kTurn * static_cast<double>(i) / static_cast<double>(errors.size()),
                      errors[i] * 1e-6 / bases.b_n});
  }
  const auto table =
      std::make_shared<const PeriodicTable>("pitch errors", points, Interpolation::cubic);
  (*curves)["pitch_" + gear] = table;
  (*curves)["pitch_bend_" + gear] =
      std::make_shared<const PeriodicTable>(table->bend().times(-1.0));
}

// The path of contact, 0 to 1, is half a turn. The other half, which nobody reads, leads back.
std::shared_ptr<const PeriodicTable> over_half_a_turn(std::vector<TablePoint> points) {
  if (points.front().phase > 0.0) points.insert(points.begin(), {0.0, points.front().value});
  if (points.back().phase < 1.0) points.push_back({1.0, points.back().value});
  for (TablePoint& point : points) point.phase *= std::numbers::pi;
  return std::make_shared<const PeriodicTable>("damage", points, Interpolation::linear);
}

// The damage of tooth 0 over the path of contact; whether there is one.
bool add_damage_curve(GearReader& in, const GearGeometry& geometry, std::size_t gear, double factor,
                      Curves* curves) {
  const GearKey& key = gear == 0 ? kPinionDamage : kGearDamage;
  const std::optional<std::vector<TablePoint>> points = curve_over_path(in, key);
  if (!points) return false;
  if (in.is_swept(kDamage) || factor > 0.0) {
    fail_at(in.node(key),
            fmt::format("{} and damage both give the damage of one tooth; keep one", key.name));
  }
  if (geometry.helix > 0.0) fail_at(in.node(key), fmt::format("{} is for spur gears", key.name));
  constexpr std::size_t kMost = 100;  // the phase grid has a segment for each
  if (points->size() > kMost) {
    fail_at(in.node(key), fmt::format("{} has {} points; at most {} are possible", key.name,
                                      points->size(), kMost));
  }
  for (const TablePoint& point : *points) {
    if (point.value >= 0.0 && point.value <= 1.0) continue;
    fail_at(in.node(key), fmt::format("{} has {} at {}; a share of the stiffness is from 0 to 1",
                                      key.name, point.value, point.phase));
  }
  (*curves)[gear == 0 ? "damage_curve_p" : "damage_curve_g"] = over_half_a_turn(*points);
  return true;
}

// The curve divided by `unit`.
std::shared_ptr<const PeriodicTable> curve_of(const MeasuredCurve& measured, double unit) {
  return std::make_shared<const PeriodicTable>(measured.table->times(1.0 / unit));
}

}  // namespace

bool add_transmission_error(GearReader& in, const GearGeometry& geometry, const ContactPath& path,
                            const GearBases& bases, GearParameters* parameters,
                            std::vector<std::string>* notes) {
  const std::optional<MeasuredCurve> measured =
      measured_curve(in, kErrorFile, Interpolation::cubic);
  std::vector<Harmonic> series = measured ? measured_error(in, *measured, notes) : given_error(in);
  const std::optional<std::vector<TablePoint>> removed = curve_over_path(in, kProfileFile);
  if (removed) {
    if (geometry.helix > 0.0) {
      fail_at(in.node(kProfileFile), "profile_deviation_file is for spur gears");
    }
    series = sum_of(std::move(series), profile_error(*removed, path.contact_ratio()));
    notes->push_back(
        fmt::format("transmission error: with the first {} harmonics of what the "
                    "profile's deviations add",
                    kMostHarmonics));
  }
  const GearKey& origin = measured ? kErrorFile : kTransmissionError;
  const bool has_phases = measured || removed || in.has(kErrorPhase);
  const GearKey& phase_origin = in.has(kErrorPhase) ? kErrorPhase : origin;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = series[i].amplitude * 1e-6;
    parameters->add(name_in_list("e0", i), error / bases.b_n, origin,
                    fmt::format("e/b_n = {:.6g} m / {:.6g} m", error, bases.b_n));
    if (!has_phases) continue;
    parameters->add(name_in_list("e0_phase", i), series[i].phase, phase_origin,
                    fmt::format("{:.6g} degrees", series[i].phase * 180.0 / std::numbers::pi));
  }
  return series.size() == 1;
}
bool add_faults(GearReader& in, const GearGeometry& geometry, const GearBases& bases,
                GearParameters* parameters, Curves* curves) {
  const std::vector<double> runout = in.pair_or_zero(kRunout);
  const std::vector<double> phase = in.pair_or_zero(kRunoutPhase);
  const std::vector<double> damage = in.pair_or_zero(kDamage);
  const std::array<double, 2> teeth = {geometry.pinion_teeth, geometry.gear_teeth};
  std::size_t cycle = 1;
  bool is_faulty = false, has_pitch = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string gear = i == 0 ? "p" : "g";
    if (in.has(kRunout)) {
      parameters->add("runout_" + gear, runout[i] * 1e-6 / bases.b_n, kRunout,
                      fmt::format("{:.6g} m / {:.6g} m", runout[i] * 1e-6, bases.b_n));
    }
    if (in.has(kRunoutPhase)) {
      parameters->add("runout_phase_" + gear, phase[i] * std::numbers::pi / 180.0, kRunoutPhase,
                      fmt::format("{:.6g} degrees", phase[i]));
    }
    if (in.has(kDamage)) parameters->add("damage_" + gear, damage[i], kDamage, "as given");
    // An axis may begin with 0.
    const auto pitch = errors_of_teeth(in, i == 0 ? kPinionPitch : kGearPitch, teeth[i]);
    if (pitch) add_pitch_errors(gear, *pitch, bases, curves);
    has_pitch = has_pitch || pitch;
    const bool is_damaged = add_damage_curve(in, geometry, i, damage[i], curves) || damage[i] > 0.0;
    const bool turns =
        in.is_swept(kRunout) || in.is_swept(kDamage) || runout[i] > 0.0 || is_damaged || pitch;
    if (turns) cycle = std::lcm(cycle, static_cast<std::size_t>(teeth[i]));
    is_faulty = is_faulty || turns;
  }
  if (is_faulty) {
    parameters->add(
        "cycle", static_cast<double>(cycle), kTeeth,
        fmt::format("mesh periods until all faults come back: {:.6g} turns of the "
                    "pinion, {:.6g} of the gear",
                    static_cast<double>(cycle) / teeth[0], static_cast<double>(cycle) / teeth[1]));
  }
  return has_pitch || in.is_swept(kRunout) || runout[0] > 0.0 || runout[1] > 0.0;
}

void add_stiffness(GearReader& in, const std::optional<MeasuredCurve>& stiffness,
                   Interpolation interpolation, const GearBases& bases, GearConversion* out) {
  const auto share = measured_curve(in, kLoadShareFile, interpolation);
  const bool keeps = in.choice(kStiffnessMean) == "keep";
  if (!stiffness) {
    if (share) fail_at(in.node(kLoadShareFile), "load_share_file goes with stiffness_file");
    return;
  }
  out->curves["measured_stiffness"] = curve_of(*stiffness, keeps ? bases.k0 : stiffness->mean);
  if (share) out->curves["load_share"] = curve_of(*share, 1.0);
  out->options.push_back({"stiffness", "table"});
  out->notes.push_back(fmt::format(
      "mesh stiffness from '{}': mean {:.6g} N/m, which is {:.6g} k0{}", stiffness->table->name(),
      stiffness->mean, stiffness->mean / bases.k0, keeps ? "" : ", scaled to k0"));
}

}  // namespace gearsweep
