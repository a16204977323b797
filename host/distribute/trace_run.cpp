#include "distribute/trace_run.hpp"

#include <algorithm>
#include <cmath>

#include "distribute/history.hpp"
#include "distribute/make_engine.hpp"
#include "distribute/orbit_search.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

struct Start {
  std::vector<double> state;
  std::size_t settled = 0;  // periods behind it
  std::size_t settle = 0;   // periods from it to the record
  std::size_t length = 0;   // of the periodic orbit that it is on; 0: none was found
};

// Where a chained point goes on from: the last state of the sweep up to its neighbour.
std::optional<std::vector<double>> chained_start(const Study& study, const SweepOptions& options) {
  Study before = study;
  std::vector<double>& values = before.axes[study.initial.along].values;
  if (study.initial.policy == InitialPolicy::forward) {
    values.pop_back();
  } else {
    values.erase(values.begin());
  }
  std::vector<std::string> states;
  for (const ChannelInfo& state : study.model->states) states.push_back(state.name);
  before.selection = select_quantities(*study.model, {"poincare"}, states);
  const std::optional<SweepResult> result = run_sweep(before, options);
  if (!result) return std::nullopt;
  const std::size_t point =
      study.initial.policy == InitialPolicy::forward ? before.points() - 1 : 0;
  std::vector<double> start;
  const std::size_t record = study.integrate.record;
  for (std::size_t i = 0; i < states.size(); ++i) {
    start.push_back(result->samples[(point * states.size() + i + 1) * record - 1]);
  }
  return start;
}

// The point that is followed: of a chained study the last one of its chain.
std::size_t followed_point(const Study& study) {
  return study.is_chained() && study.initial.policy == InitialPolicy::forward ? study.points() - 1
                                                                              : 0;
}

std::optional<std::vector<double>> initial_state(const Plan& plan, const SweepOptions& options) {
  const Study& study = plan.study();
  const std::size_t point = followed_point(study);
  if (study.points() == 1) return plan.own_initial_state(point);
  std::optional<std::vector<double>> start = chained_start(study, options);
  // A point whose predecessor has diverged starts on its own.
  if (start && std::isnan(start->front())) return plan.own_initial_state(point);
  return start;
}

// Settles as a sweep does: on the orbit that is found, or to the end.
std::optional<Start> find_start(const Plan& plan, const Tile& tile,
                                const std::vector<double>& initial, Engine* engine,
                                const RoundCallback& after_round) {
  const std::size_t settle = plan.study().integrate.settle;
  OrbitSearch search(plan, tile, initial, searched_periods(plan.study()), engine->orbits());
  while (search.can_advance()) {
    if (!search.advance(after_round)) return std::nullopt;
    if (search.found().empty()) continue;
    const FoundOrbit& orbit = search.found().front();
    return Start{orbit.state, orbit.settled, (settle - orbit.settled) % orbit.length, orbit.length};
  }
  if (!search.diverged().empty()) return Start{};
  return Start{search.states(), search.settled(), settle - search.settled()};
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

}  // namespace

std::optional<Trace> run_trace(const Study& study, std::size_t samples_per_period,
                               const SweepOptions& options) {
  const std::unique_ptr<Engine> engine = make_engine(
      study, options.devices.empty() ? std::nullopt : std::optional(options.devices.front()));
  const Plan plan(study, study.points());
  const std::size_t point = followed_point(study);
  const Tile tile = {{point}, {0}, 0.0};
  const auto after_round = [&](double) { return options.stop == nullptr || !*options.stop; };
  const std::optional<std::vector<double>> initial = initial_state(plan, options);
  if (!initial) return std::nullopt;
  const std::optional<Start> start = find_start(plan, tile, *initial, engine.get(), after_round);
  if (!start) return std::nullopt;
  std::optional<std::vector<double>> rows;
  if (!start->state.empty()) {
    const std::size_t record = study.integrate.record;
    const std::size_t turn = start->length > 0 ? std::min(start->length, record) : record;
    rows = engine->rows(plan, point, start->state, start->settle, turn, after_round);
    if (!rows) return std::nullopt;
    repeat_turn(record, turn, &*rows);
  }
  if (!rows || rows->empty()) throw RunError("the point diverges before there is anything to see");
  Trace trace = trace_of(plan, point, *rows, samples_per_period);
  trace.settled = start->settled + start->settle;
  return trace;
}

}  // namespace gearsweep
