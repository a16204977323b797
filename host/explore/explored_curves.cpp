#include "explore/explored_curves.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "model/error.hpp"
#include "plan/passive_states.hpp"
#include "point/point_trace.hpp"
#include "result/border_plane.hpp"

namespace gearsweep {
namespace {

// Moments in a mesh period: enough of a short orbit to be a round line.
std::size_t samples_of_orbit(std::size_t mesh_periods) {
  constexpr std::size_t kMin = 40, kWanted = 400;
  return std::max(kMin, kWanted / mesh_periods);
}

// Between the ends of a trace, in ranges of these states; angles are the same after a full turn.
double gap_of(const Trace& trace, const Model& model, const std::vector<std::size_t>& states) {
  double gap = 0.0;
  for (const std::size_t i : states) {
    const std::vector<double>& series = trace.values[i];
    const auto [low, high] = std::ranges::minmax(series);
    double between = series.back() - series.front();
    if (std::ranges::find(model.angles, i) != model.angles.end()) {
      between = std::remainder(between, 2.0 * std::numbers::pi);
    }
    const double range = high - low;
    if (range > 0.0) gap = std::max(gap, std::fabs(between) / range);
  }
  return gap;
}

// The states of an orbit by name, with those that mirror them.
std::vector<NamedValue> states_of(const StoredOrbit& orbit, const ExploredCurves& curves) {
  const std::vector<ChannelInfo>& states = curves.study.model->states;
  std::vector<NamedValue> out;
  for (std::size_t i = 0; i < curves.kept.size(); ++i) {
    out.push_back({states[curves.kept[i]].name, orbit.state[i]});
    for (const MirrorPairs::Pair& pair : curves.mirrors) {
      if (pair.first == curves.kept[i]) {
        out.push_back({states[pair.second].name, -orbit.state[i]});
      }
    }
  }
  return out;
}

// Those that drive nothing, of which the search knew nothing.
std::string note_of_others(const Model& model, const std::vector<NamedValue>& known) {
  std::vector<std::string> others;
  for (const ChannelInfo& state : model.states) {
    if (std::ranges::find(known, state.name, &NamedValue::name) == known.end()) {
      others.push_back(state.name);
    }
  }
  if (others.empty()) return "";
  return fmt::format(
      "{} drive nothing, and the file has no states of theirs: they begin where the map's motions "
      "do.",
      fmt::join(others, ", "));
}

// From the file's state at phase 0 on, to the same moment so many forcing periods later.
void follow_orbit(std::size_t periods, const ExploredCurves& curves, const SweepOptions& options,
                  BorderMotion* border) {
  Motion* const motion = &border->motion;
  const Model& model = *motion->study.model;
  std::vector<NamedValue> at = motion->at;
  at.insert(at.end(), border->start.begin(), border->start.end());
  const Place place = find_place(motion->study, at, "");
  Study placed = motion->study;
  place_parameters(place, &placed);
  const auto meshes = static_cast<std::size_t>(model.mesh_periods(placed.setting));
  border->turn = periods * meshes;
  const std::size_t samples = samples_of_orbit(border->turn);
  // A period more, whose first moment is the end of the turn.
  const TraceWindows windows = {0, border->turn + meshes};
  PointTraces found;
  if (!add_point_trace(motion->study, place, windows, samples, options, &found)) {
    throw RunError("interrupted");
  }
  Trace trace = std::move(found.traces.front());
  const std::size_t moments = border->turn * samples + 1;
  trace.tau.resize(moments);
  for (std::vector<double>& series : trace.values) series.resize(moments);
  border->gap = gap_of(trace, model, curves.kept);
  motion->trace = std::move(trace);
  motion->samples_per_period = samples;
}

// name: of the curves. origin: as require_plane() has it.
ExploredCurves explored(StoredCurves stored, Study of_curves, const Study& study,
                        const std::string& name, const std::string& origin) {
  ExploredCurves curves;
  curves.stored = std::move(stored);
  curves.study = std::move(of_curves);
  require_plane(origin, curves.study, study);
  Study base = curves.study;
  base.separate_points();
  const Study reduced = without_passive_states(base);  // as the search for curves does
  const Model& model = *reduced.model;
  if (model.state_names() != curves.stored.states) {
    throw InputError(fmt::format("'{}' has orbits that are not of its own study", name));
  }
  curves.kept = model.reduction.kept;
  curves.mirrors = model.reduction.mirrors;
  if (model.whole == nullptr) {
    curves.kept.resize(model.states.size());
    std::iota(curves.kept.begin(), curves.kept.end(), std::size_t{0});
  }
  return curves;
}

}  // namespace

ExploredCurves read_explored_curves(const std::string& path, const Study& study,
                                    const std::string& option) {
  StoredCurves stored = read_borders(path);
  Study of_curves = read_border_study(path, stored);
  return explored(std::move(stored), std::move(of_curves), study, path,
                  fmt::format("{} {}", option, path));
}

ExploredCurves explored_curves(StoredCurves stored, Study of_curves, const Study& study,
                               const std::string& name) {
  require_own_study(name, of_curves, stored);
  return explored(std::move(stored), std::move(of_curves), study, name, name);
}

BorderMotion find_border_motion(const Scene& scene, const ExploredCurves& curves,
                                const CurvePlace& place, const SweepOptions& options) {
  const StoredCurve& curve = curves.stored.curves.at(place.curve);
  const auto [x, y] = curve.places.at(place.point);
  BorderMotion border;
  border.place = place;
  border.start = states_of(curve.orbits.at(place.point), curves);
  Motion& motion = border.motion;
  const bool is_turned = scene.study().axes[0].name != curves.stored.x;
  motion.study = scene.at({{{is_turned ? y : x}, {is_turned ? x : y}}});
  // By the steps that the point was solved with, if those are more.
  Integrate& integrate = motion.study.integrate;
  integrate.steps_per_period = std::max(integrate.steps_per_period, curves.stored.steps);
  integrate.stop = Stop::never;
  for (const Axis& axis : motion.study.axes) motion.at.push_back({axis.name, axis.values.front()});
  motion.is_on_orbit = true;
  try {
    follow_orbit(static_cast<std::size_t>(curve.period), curves, options, &border);
    const std::string note = note_of_others(*motion.study.model, border.start);
    if (!note.empty()) motion.notes.push_back(note);
  } catch (const InputError& error) {
    motion.notes.push_back(std::string("no trace: ") + error.what());
  } catch (const RunError& error) {
    motion.notes.push_back(std::string("no trace: ") + error.what());
  }
  return border;
}

}  // namespace gearsweep
