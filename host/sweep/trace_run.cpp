#include "sweep/trace_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/error.hpp"
#include "scheduler/make_engine.hpp"
#include "sweep/detail/history.hpp"
#include "sweep/detail/machine.hpp"
#include "sweep/sweep.hpp"
#include "tile/settled_point.hpp"

namespace gearsweep {
namespace {

// The point that is followed: of a chained study the last one of its chain.
std::size_t followed_point(const Plan& plan) {
  return plan.stages().back().tiles.back().points.back();
}

// Where the followed point of a chained study goes on from: the last state of the sweep up to its
// neighbour.
std::optional<std::vector<double>> chained_start(const Plan& plan, const SweepOptions& options) {
  const Study& study = plan.study();
  const std::size_t along = study.initial.along;
  Study before = study;
  const std::size_t followed = study.axis_index(along, followed_point(plan));
  std::vector<std::size_t> places(before.axes[along].values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::erase(places, followed);
  before.axes[along] = before.axes[along].at(places);
  std::vector<std::string> states;
  for (const ChannelInfo& state : study.model->states) states.push_back(state.name);
  before.selection = select_quantities(*study.model, {"poincare"}, states);
  const std::optional<SweepResult> result = run_sweep(before, options);
  if (!result) return std::nullopt;
  const std::size_t point = followed_point(Plan(before, before.points()));
  std::vector<double> start;
  for (std::size_t i = 0; i < states.size(); ++i) {
    start.push_back(samples_of(*result, point, i).back());
  }
  return start;
}

std::optional<std::vector<double>> initial_state(const Plan& plan, const SweepOptions& options) {
  const Study& study = plan.study();
  const std::size_t point = followed_point(plan);
  if (study.points() == 1) return plan.own_initial_state(point);
  std::optional<std::vector<double>> start = chained_start(plan, options);
  // A point whose predecessor has diverged starts on its own.
  if (start && std::isnan(start->front())) return plan.own_initial_state(point);
  return start;
}

// The map of a point that stopped on an orbit repeats its one turn, and so does its trace.
void repeat_turn(std::size_t record, std::size_t turn, std::vector<double>* rows) {
  const std::size_t of_period = rows->size() / turn;
  rows->reserve(of_period * record);
  for (std::size_t period = turn; period < record && of_period > 0; ++period) {
    const std::size_t first = period % turn * of_period;
    for (std::size_t i = 0; i < of_period; ++i) rows->push_back((*rows)[first + i]);
  }
}

// In bytes: the states at both ends of all steps, and the trace, which is copied into a file.
double memory_of(const Plan& plan, std::size_t point, std::size_t samples_per_period) {
  constexpr double kCopies = 3.0;
  const Model& model = *plan.study().model;
  const auto record = static_cast<double>(plan.study().integrate.record);
  const double rows = record * static_cast<double>(plan.steps_of(point));
  const double moments =
      samples_per_period > 0 ? record * static_cast<double>(samples_per_period) : rows;
  const auto states = static_cast<double>(model.states.size());
  const auto signals = static_cast<double>(model.signals.size() + model.contacts.size());
  return (rows * states + kCopies * moments * (1.0 + states + signals)) * sizeof(double);
}

void refuse_too_long(double needed, const Study& study) {
  const std::optional<double> available = available_memory();
  if (!available || needed <= *available) return;
  throw InputError(fmt::format(
      "a trace of {} periods of the forcing takes {:.3g} GB of memory, and {:.3g} GB are free: "
      "record fewer, or take fewer samples in a period",
      study.integrate.record, needed / 1e9, *available / 1e9));
}

}  // namespace

std::optional<Trace> run_trace(const Study& study, std::size_t samples_per_period,
                               const SweepOptions& options) {
  const Plan plan(study, study.points());
  const std::size_t point = followed_point(plan);
  const Plan orbit_plan = plan.with_shorter_steps(study.integrate.orbit_steps);
  refuse_too_long(memory_of(orbit_plan, point, samples_per_period), study);
  const std::unique_ptr<Engine> engine = make_engine(
      study, options.devices.empty() ? std::nullopt : std::optional(options.devices.front()),
      options.scheduler.get());
  const auto after_round = [&](double) { return options.stop == nullptr || !*options.stop; };
  const std::optional<std::vector<double>> initial = initial_state(plan, options);
  if (!initial) return std::nullopt;
  const std::optional<SettledPoint> start =
      settle_point(plan, orbit_plan, point, *initial, engine.get(), after_round);
  if (!start) return std::nullopt;
  std::optional<std::vector<double>> rows;
  const Plan& recorded = start->length > 0 ? orbit_plan : plan;
  if (!start->state.empty()) {
    const std::size_t record = study.integrate.record;
    const std::size_t turn = start->length > 0 ? std::min(start->length, record) : record;
    rows = engine->rows(recorded, point, start->state, start->settle, turn, after_round);
    if (!rows) return std::nullopt;
    repeat_turn(record, turn, &*rows);
  }
  if (!rows || rows->empty()) throw RunError("the point diverges before there is anything to see");
  Trace trace = trace_of(recorded, point, *rows, samples_per_period);
  trace.settled = start->settled + start->settle;
  return trace;
}

}  // namespace gearsweep
