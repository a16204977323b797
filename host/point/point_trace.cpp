#include "point/point_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/error.hpp"
#include "study/draft.hpp"
#include "sweep/trace_run.hpp"

namespace gearsweep {
namespace {

// The axis that a chained study goes along, up to the point with this value.
Axis chain_to(const Study& whole, double value) {
  const Axis& axis = whole.axes[whole.initial.along];
  const auto own =
      static_cast<std::size_t>(std::ranges::find(axis.values, value) - axis.values.begin());
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < axis.values.size(); ++place) {
    const bool is_before =
        info_of(whole.initial.policy).neighbour < 0 ? place <= own : place >= own;
    if (is_before) places.push_back(place);
  }
  return axis.at(places);
}

// The place has an initial state that no axis sweeps.
bool moves_start(const Study& whole, const Place& place) {
  return std::any_of(place.values.begin(), place.values.end(), [&](const Placed& placed) {
    return placed.is_state &&
           std::none_of(whole.axes.begin(), whole.axes.end(),
                        [&](const Axis& axis) { return is_swept(axis, placed); });
  });
}

// The study of one point, as run_trace() wants it.
Study traced_study(const Study& whole, const Place& place) {
  Study study = whole;
  place_parameters(place, &study);
  if (whole.is_chained()) {
    if (moves_start(whole, place)) {
      throw InputError(
          told_of(place.origin, "an initial state fits no study that sweeps along an axis"));
    }
    Axis& along = study.axes[study.initial.along];
    along = chain_to(whole, along.values.front());
  } else if (moves_start(whole, place)) {
    place_states(place, &study);
  }
  study.initial.ensemble = 1;
  return study;
}

void add_names(const Study& whole, const Place& place, std::vector<std::string>* names) {
  const auto add = [&](std::size_t parameter) {
    const std::string& name = whole.model->parameters[parameter].name;
    if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  };
  for (const Axis& axis : whole.axes) {
    for (const Swept& column : axis.columns) {
      if (!column.is_state) add(column.index);
    }
  }
  for (const Placed& placed : place.values) {
    if (!placed.is_state) add(placed.index);
  }
  for (const DerivedParameter& derived : whole.model->derived) {
    if (whole.differs(derived.parameter)) add(derived.parameter);
  }
}

// So many mesh periods as periods of the forcing, rounded up.
std::size_t forcing_periods(const Study& study, std::size_t mesh_periods) {
  return static_cast<std::size_t>(
      std::ceil(static_cast<double>(mesh_periods) / study.model->mesh_periods(study.setting)));
}

}  // namespace

Study with_windows(const Study& study, const TraceWindows& windows) {
  std::vector<std::string> overrides;
  const auto add = [&](const char* key, std::size_t mesh_periods) {
    overrides.push_back(fmt::format("integrate.{}={}", key, forcing_periods(study, mesh_periods)));
  };
  if (windows.settle) {
    add("settle", *windows.settle);
    overrides.emplace_back("integrate.stop=never");
  }
  if (windows.record) add("record", *windows.record);
  if (overrides.empty()) return study;
  Study changed = read_draft(study.toml, "study", overrides);
  // The step may be that of a map, which the text does not have.
  FoundStep::of(study).give_to(&changed);
  changed.integrate.tolerance = study.integrate.tolerance;
  return changed;
}

void settle_step(const std::optional<FoundStep>& pilot_step, Study* study) {
  if (study->integrate.tolerance <= 0.0) return;
  if (!pilot_step && study->integrate.is_tolerance_asked) {
    throw InputError(fmt::format(
        "integrate.tolerance takes a map to find the step: give the finished map (MAP.nc) in the "
        "study's place, or give the step, --set integrate.tolerance=0 --set "
        "integrate.max_step={}",
        study->integrate.max_step));
  }
  if (pilot_step) pilot_step->give_to(study);
  study->integrate.tolerance = 0.0;
}

bool add_point_trace(const Study& whole, Place place, const TraceWindows& windows,
                     std::size_t samples_per_period, const SweepOptions& options,
                     PointTraces* out) {
  const std::string notice = move_to_chain(whole, &place);
  if (!notice.empty()) out->notices.push_back(notice);
  Study study = traced_study(whole, place);
  if (windows.settle) study.integrate.settle = forcing_periods(study, *windows.settle);
  if (windows.record) study.integrate.record = forcing_periods(study, *windows.record);
  const auto of_forcing = static_cast<std::size_t>(study.model->mesh_periods(study.setting));
  std::optional<Trace> trace = run_trace(study, samples_per_period * of_forcing, options);
  if (!trace) return false;
  out->traces.push_back(*std::move(trace));
  out->labels.push_back(label_of(*whole.model, place));
  add_names(whole, place, &out->placed);
  return true;
}

}  // namespace gearsweep
