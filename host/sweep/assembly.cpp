#include "sweep/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "model/array.hpp"
#include "sweep/detail/map_value.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// What to call the values of `attractor`, from 0; empty when there are too many to tell apart by
// name.
std::vector<std::string> class_names(const std::vector<Attractor>& attractors) {
  constexpr std::size_t kMaxNames = 30;
  if (attractors.size() > kMaxNames) return {};
  std::vector<std::string> names = {"undecided"};
  for (const Attractor& attractor : attractors) {
    const std::string kind = attractor.period > 0.0 ? fmt::format("period_{}", attractor.period)
                                                    : motion_names().at(attractor.motion);
    names.push_back(fmt::format("{}_{}", names.size(), kind));
  }
  return names;
}

}  // namespace

Assembly::Assembly(const Study& study, std::size_t states) {
  const std::size_t points = study.points();
  const Selection& selection = study.selection;
  result_.study = study;
  result_.status.resize(points);
  result_.on_orbit.resize(points);
  for (const Quantity& quantity : selection.quantities) {
    result_.values.emplace_back(points * quantity.width);
  }
  result_.samples.resize(points * selection.poincare.size() * study.integrate.record);
  if (study.stages() > 1) final_states_.resize(points * states);
  if (selection.census) summaries_.resize(study.trajectories());
  if (study.uncertain.draws() > 0) draws_.emplace(study);
}

void Assembly::add(const Plan& plan, const Tile& tile, const TileResult& result) {
  devices_.insert(result.device);
  result_.steps += result.cost.steps;
  result_.seconds += result.cost.seconds;
  result_.kernel_seconds += result.cost.kernel_seconds;
  result_.stopped += static_cast<std::size_t>(result.cost.stopped);
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    const std::size_t point = tile.points[i];
    if (!summaries_.empty()) add_summary(point, result, i);
    // The maps are those of each point's first trajectory.
    if (point >= result_.status.size()) {
      if (draws_) draws_->add(plan, point, result, i);
      continue;
    }
    result_.status[point] = result.status[i];
    if (!result.on_orbit.empty()) result_.on_orbit[point] = result.on_orbit[i];
    for (std::size_t j = 0; j < result_.values.size(); ++j) {
      const Quantity& quantity = result_.study.selection.quantities[j];
      if (quantity.of_census || quantity.of_draws) continue;
      const std::span<double> value = Array2(result_.values[j], quantity.width)[point];
      for (std::size_t k = 0; k < quantity.width; ++k) {
        value[k] = map_value(plan, quantity, k, point, result, i);
      }
    }
    const auto copy = [&](const std::vector<double>& from, std::vector<double>* to) {
      const std::size_t width = from.size() / tile.points.size();
      std::ranges::copy(Array2(from, width)[i], Array2(*to, width)[point].begin());
    };
    copy(result.samples, &result_.samples);
    if (!final_states_.empty()) copy(result.final_states, &final_states_);
  }
}

std::vector<double> Assembly::initial_states(const Plan& plan, const Tile& tile) const {
  const std::size_t states = plan.study().model->states.size();
  std::vector<double> initial;
  initial.reserve(tile.points.size() * states);
  for (const std::size_t point : tile.points) {
    const std::optional<std::size_t> before = plan.points().predecessor(point);
    if (!before || !has_values(result_.status[*before])) {
      append(plan.own_initial_state(point), &initial);
      continue;
    }
    const std::span<const double> end = Array2(final_states_, states)[*before];
    if (plan.study().is_chained()) {
      append(end, &initial);
      continue;
    }
    // A draw of other loads rests elsewhere, and so does its motion.
    std::vector<double> start = plan.own_initial_state(point);
    const std::vector<double> nominal = plan.own_initial_state(*before);
    for (std::size_t i = 0; i < states; ++i) start[i] += end[i] - nominal[i];
    append(start, &initial);
  }
  return initial;
}

void Assembly::add_summary(std::size_t trajectory, const TileResult& result, std::size_t position) {
  const CensusOutputs& census = *result_.study.selection.census;
  const auto output = [&](std::size_t index) { return result.output_table()[index][position]; };
  TrajectorySummary& summary = summaries_[trajectory];
  if (!has_values(result.status[position]) || output(census.motion) == double{MOTION_undecided})
    return;
  summary.is_known = true;
  summary.motion = static_cast<std::size_t>(output(census.motion));
  summary.period = summary.motion == MOTION_equilibrium ? 0.0 : output(census.period);
  summary.rms = output(census.rms);
  summary.exponent = output(census.exponent);
  summary.peak = census.peak ? output(*census.peak) : std::numeric_limits<double>::quiet_NaN();
  if (census.impacts_drive) {
    summary.impacts_drive = output(*census.impacts_drive);
    summary.impacts_back = output(*census.impacts_back);
  }
  const Model& model = *result_.study.model;
  const auto numbers = [&](std::size_t first, std::size_t second) {
    std::vector<double> out;
    out.reserve(2 * model.states.size());
    for (const std::size_t from : {first, second}) {
      for (std::size_t i = 0; i < model.states.size(); ++i) out.push_back(output(from + i));
    }
    return out;
  };
  if (summary.motion == MOTION_periodic && !model.is_autonomous) {
    summary.place = numbers(census.section_min, census.section_max);
  } else {
    summary.place = numbers(census.mean, census.std);
    summary.errors = numbers(census.mean_error, census.std_error);
  }
}

void Assembly::take_census() {
  AttractorList list = find_attractors(result_.study, summaries_);
  for (std::size_t j = 0; j < result_.values.size(); ++j) {
    Quantity& quantity = result_.study.selection.quantities[j];
    if (!quantity.of_census) continue;
    if (quantity.name == "attractor") quantity.flags = class_names(list.attractors);
    for (std::size_t point = 0; point < result_.status.size(); ++point) {
      const std::size_t value =
          quantity.name == "attractor" ? list.number[point] : list.count[point];
      result_.values[j][point] = has_values(result_.status[point])
                                     ? static_cast<double>(value)
                                     : std::numeric_limits<double>::quiet_NaN();
    }
  }
  result_.attractors = std::move(list.attractors);
  result_.uncertain = list.uncertain;
}

SweepResult Assembly::take() {
  if (!summaries_.empty()) take_census();
  if (draws_) draws_->reduce(&result_.values);
  result_.engine.device = fmt::format("{}", fmt::join(devices_, "; "));
  return std::move(result_);
}

}  // namespace gearsweep
