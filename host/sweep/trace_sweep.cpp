#include "sweep/trace_sweep.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "scheduler/make_engine.hpp"
#include "sweep/detail/history.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// The study that settles the points and gives their last states.
Study settling_study(const Study& study) {
  Study settling = study;
  settling.integrate.record = 1;
  settling.selection = select_quantities(*study.model, {"poincare"}, study.model->state_names());
  return settling;
}

std::vector<double> last_state(const SweepResult& settled, std::size_t point) {
  std::vector<double> state;
  for (std::size_t i = 0; i < settled.study.selection.poincare.size(); ++i) {
    state.push_back(samples_of(settled, point, i).back());
  }
  return state;
}

}  // namespace

bool sweep_traces(const Study& study, std::size_t samples_per_period, const SweepOptions& options,
                  const TakeTrace& take) {
  const std::optional<SweepResult> settled = run_sweep(settling_study(study), options);
  if (!settled) return false;
  const std::unique_ptr<Engine> engine = make_engine(
      study, options.devices.empty() ? std::nullopt : std::optional(options.devices.front()),
      options.scheduler.get());
  const Plan plan(study, study.points());
  const auto after_round = [&](double) { return options.stop == nullptr || !*options.stop; };
  for (std::size_t point = 0; point < study.points(); ++point) {
    const std::vector<double> start = last_state(*settled, point);
    std::optional<std::vector<double>> rows = std::vector<double>{};
    if (!std::isnan(start.front())) {
      rows = engine->rows(plan, point, start, 0, study.integrate.record, after_round);
    }
    if (!rows) return false;
    std::optional<Trace> trace;
    if (!rows->empty()) trace = trace_of(plan, point, *rows, samples_per_period);
    const std::size_t moments = samples_per_period * study.integrate.record;
    const bool is_whole = trace && trace->tau.size() == moments;
    take(point, is_whole ? &*trace : nullptr);
  }
  return true;
}

}  // namespace gearsweep
