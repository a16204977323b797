#include "explore/motion.hpp"

#include "model/error.hpp"
#include "orders/spectrum.hpp"
#include "point/point_orbit.hpp"
#include "point/point_trace.hpp"
#include "sweep/sweep.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// Enough to see a motion and its section, and no more than a page draws at once. Subharmonics of 2,
// 3, 4, 5, 6, 8, 10 and 12 periods are whole bins of the spectrum.
constexpr std::size_t kPeriods = 120, kSamplesPerPeriod = 40;

void add_trace(const SweepOptions& options, Motion* motion) {
  PointTraces found;
  const TraceWindows windows = {std::nullopt, kPeriods};
  Place place = find_place(motion->study, motion->at, "");
  if (!add_point_trace(with_windows(motion->study, windows), place, windows, kSamplesPerPeriod,
                       options, &found)) {
    return;
  }
  motion->trace = std::move(found.traces.front());
  motion->samples_per_period = kSamplesPerPeriod;
}

// The study of one point alone.
Study study_at(const Scene& scene, const Cell& cell) {
  return scene.at(
      {{{scene.value_at(0, cell.k[0], cell.depth)}, {scene.value_at(1, cell.k[1], cell.depth)}}});
}

std::vector<NamedValue> place_of(const Study& point) {
  std::vector<NamedValue> at;
  for (const Axis& axis : point.axes) at.push_back({axis.name, axis.values.front()});
  return at;
}

// By the study's own quantities. A motion that repeats need not have stopped on its orbit.
bool is_told_periodic(const Motion& motion) {
  for (std::size_t i = 0; i < motion.values.size(); ++i) {
    const Quantity& quantity = motion.study.selection.quantities[i];
    const double value = motion.values[i];
    if (quantity.name == "period" && value > 0.0) return true;
    if (quantity.role == OutputRole::motion && value == double{MOTION_periodic}) return true;
  }
  return false;
}

// A note says what is missing.
template <typename Find>
void try_to(const char* what, const Find& find, Motion* motion) {
  try {
    find();
  } catch (const InputError& error) {
    motion->notes.push_back(std::string(what) + ": " + error.what());
  } catch (const RunError& error) {
    motion->notes.push_back(std::string(what) + ": " + error.what());
  }
}

}  // namespace

Motion find_motion(const Scene& scene, const Cell& cell, const SweepOptions& options) {
  Motion motion;
  motion.study = study_at(scene, cell);
  motion.at = place_of(motion.study);
  const std::optional<SweepResult> result = run_sweep(motion.study, options);
  if (!result) throw RunError("interrupted");
  motion.status = result->status.front();
  for (const std::vector<double>& map : result->values) motion.values.push_back(map.front());
  if (!has_values(motion.status)) {
    motion.notes.emplace_back(motion.status == STATUS_diverged
                                  ? "the motion goes to infinity, so there is no trace of it"
                                  : "the steps are too long to follow the motion: give the study a "
                                    "shorter integrate.max_step");
    return motion;
  }
  try_to(
      "no trace", [&] { add_trace(options, &motion); }, &motion);
  motion.is_on_orbit = result->on_orbit.front() != 0 || is_told_periodic(motion);
  return motion;
}

void add_spectrum(Motion* motion) {
  if (!motion->trace) return;
  MotionSpectrum spectrum;
  for (std::size_t i = 0; i < motion->trace->channels.size(); ++i) {
    Spectrum of_channel = amplitude_spectrum(*motion->trace, i, 0);
    spectrum.order_step = of_channel.order_step;
    spectrum.amplitude.push_back(std::move(of_channel.amplitude));
  }
  motion->spectrum = std::move(spectrum);
}

MotionOrbit find_motion_orbit(const Scene& scene, const Cell& cell, const SweepOptions& options) {
  const Study study = study_at(scene, cell);
  OrbitRequest request;
  request.place = find_place(study, place_of(study), "");
  const std::optional<OrbitFindings> found = find_point_orbit(study, request, options);
  if (!found) throw RunError("interrupted");
  const Orbit& orbit = found->orbit;
  return {{orbit.multipliers.begin(), orbit.multipliers.end()},
          orbit.period,
          orbit.kind == OrbitKind::equilibrium,
          orbit.stable()};
}

}  // namespace gearsweep
