#include "reference/reference_engine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "model/array.hpp"
#include "reference/detail/lyapunov_observables.hpp"
#include "reference/detail/observables.hpp"
#include "reference/detail/section_observables.hpp"
#include "reference/detail/trajectory.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// The answers for one point.
struct PointResult {
  bool diverged = false;
  Eigen::VectorXd state;
  std::vector<double> outputs, samples;
};

using Observables = std::vector<std::unique_ptr<ReferenceObservable>>;

// What moments of the record count in averages (kernels/observe.h: window_weight).
class RecordWindow {
 public:
  RecordWindow(bool is_clockless, std::size_t periods)
      : is_clockless_(is_clockless), periods_(static_cast<double>(periods)) {}

  // The steps in their order.
  void weigh(TrajectoryStep* step) {
    step->once_before = at(time_);
    step->once = at(time_ + 0.5 * step->share);
    step->weight = step->once * step->share;
    time_ += step->share;
  }

 private:
  double at(double time) const {
    const double place = time / periods_;
    return is_clockless_ ? 30.0 * std::pow(place * (1.0 - place), 2) : 1.0;
  }

  bool is_clockless_;
  double periods_, time_ = 0.0;
};

// The states that a study samples at the section, of a record.
class SectionSamples {
 public:
  SectionSamples(std::vector<std::size_t> states, std::size_t count)
      : states_(std::move(states)),
        count_(count),
        samples_(states_.size() * count, std::numeric_limits<double>::quiet_NaN()) {}

  void keep(const Eigen::VectorXd& state) {
    for (std::size_t j = 0; j < states_.size() && next_ < count_; ++j) {
      samples_[j * count_ + next_] = state[static_cast<Eigen::Index>(states_[j])];
    }
    ++next_;
  }

  std::vector<double> take() { return std::move(samples_); }

 private:
  std::vector<std::size_t> states_;
  std::size_t count_, next_ = 0;
  std::vector<double> samples_;  // [state][sample]; what is not reached is no number
};

// One point, whose tangents are orthonormalized.
class PointRun {
 public:
  PointRun(const Plan& plan, std::size_t point, const Eigen::VectorXd& initial)
      : study_(plan.study()), setting_(plan.setting_of(point)), trajectory_(plan, point, initial) {}

  // Whether it stays within bounds.
  bool settle(std::size_t periods) {
    const std::size_t tangents = study_.selection.tangent_count();
    const std::size_t warm_up = std::min(study_.integrate.warm_up, periods);
    for (std::size_t i = 0; i < periods; ++i) {
      if (i == periods - warm_up) set_start_tangents(tangents, *study_.model, &trajectory_);
      if (!advance(StepCallback())) return false;
    }
    if (warm_up == 0) set_start_tangents(tangents, *study_.model, &trajectory_);
    return true;
  }

  // The same.
  bool record(const Window& window, const Observables& observables, SectionSamples* samples) {
    for (const auto& observable : observables) observable->begin(trajectory_.state());
    std::optional<SectionWatch> section;
    if (const std::string& named = study_.selection.section; !named.empty()) {
      section.emplace(*std::ranges::find(study_.model->sections, named, &SectionInfo::name));
    }
    const auto keep = [&](const Eigen::VectorXd& state, double) { samples->keep(state); };
    RecordWindow weights(study_.model->is_clockless, window.record);
    bool is_within = true;
    for (std::size_t i = 0; i < window.record && is_within; ++i) {
      is_within = advance([&](TrajectoryStep& step) {
        weights.weigh(&step);
        for (const auto& observable : observables) observable->step(step);
        if (section) section->see(step, keep);
      });
      for (const auto& observable : observables) {
        observable->period(trajectory_.state(), log_stretching_, trajectory_.period());
      }
      if (!section) samples->keep(trajectory_.state());
    }
    return is_within;
  }

  Observables observables() const {
    Observables observables;
    for (const Observer& observer : study_.selection.observers) {
      if (observer.observable->role == ObservableRole::samples) continue;  // kept by themselves
      observables.push_back(make_observable(study_, setting_, observer));
    }
    return observables;
  }

  const Eigen::VectorXd& state() const { return trajectory_.state(); }

 private:
  // A period.
  bool advance(const StepCallback& each_step) {
    const auto orthonormalize = [&] { log_stretching_ += orthonormalize_tangents(&trajectory_); };
    log_stretching_ = Eigen::VectorXd::Zero(trajectory_.tangents().cols());
    const bool is_within = trajectory_.advance_period(each_step, orthonormalize);
    orthonormalize();
    return is_within;
  }

  const Study& study_;
  const ModelSetting setting_;
  Trajectory trajectory_;
  Eigen::VectorXd log_stretching_;  // of the running period
};

PointResult compute_point(const Plan& plan, std::size_t point, const Eigen::VectorXd& initial,
                          const Window& window) {
  PointRun run(plan, point, initial);
  const Observables observables = run.observables();
  SectionSamples samples(plan.study().selection.poincare, window.samples);
  PointResult result;
  result.diverged = !run.settle(window.settle) || !run.record(window, observables, &samples);
  result.state = run.state();
  result.samples = samples.take();
  if (result.diverged) return result;  // has no outputs; it may have no period that observables saw
  for (const auto& observable : observables) {
    const std::vector<double> outputs = observable->finish(window);
    result.outputs.insert(result.outputs.end(), outputs.begin(), outputs.end());
  }
  return result;
}

class ReferenceEngine final : public Engine {
 public:
  EngineInfo info() const override { return {"reference engine (Eigen)", "", ""}; }
  std::size_t min_tile() const override { return 16; }
  std::size_t preferred_tile() const override { return 256; }

  std::optional<TileResult> compute(const Plan& plan, const Tile& tile,
                                    const std::vector<double>& initial, const Window& window,
                                    const RoundCallback& after_round) override {
    const std::size_t count = tile.points.size();
    const auto states = static_cast<Eigen::Index>(plan.study().model->states.size());
    std::vector<PointResult> results(count);
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stop = false;
    std::mutex mutex;  // guards `failure` and the callback
    std::exception_ptr failure;
    const auto work = [&] {
      for (std::size_t i = next++; i < count && !stop; i = next++) {
        try {
          const Eigen::VectorXd start = Eigen::Map<const Eigen::VectorXd>(
              initial.data() + static_cast<Eigen::Index>(i) * states, states);
          results[i] = compute_point(plan, tile.points[i], start, window);
          const std::lock_guard lock(mutex);
          if (!after_round(tile.work / static_cast<double>(count))) stop = true;
        } catch (...) {
          const std::lock_guard lock(mutex);
          failure = std::current_exception();
          stop = true;
        }
      }
    };
    {
      std::vector<std::jthread> threads;
      for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
        threads.emplace_back(work);
      }
    }
    if (failure) std::rethrow_exception(failure);
    if (stop) return std::nullopt;
    return collect(plan.study(), results);
  }

  std::optional<std::vector<double>> rows(const Plan& plan, std::size_t point,
                                          const std::vector<double>& initial, std::size_t settle,
                                          std::size_t record,
                                          const RoundCallback& after_round) override {
    Trajectory trajectory(plan, point,
                          Eigen::Map<const Eigen::VectorXd>(
                              initial.data(), static_cast<Eigen::Index>(initial.size())));
    std::vector<double> out;
    const auto keep = [&](const Instant& moment) {
      out.insert(out.end(), moment.state.begin(), moment.state.end());
    };
    const PhaseGrid& grid = trajectory.grid();
    for (std::size_t period = 0; period < settle + record; ++period) {
      std::size_t segment = 0, step = 0;
      bool is_within_step = false;
      const bool alive = trajectory.advance_period([&](const TrajectoryStep& taken) {
        if (period < settle) return;
        if (step == 0 && !is_within_step) keep(taken.before);
        // A step may come in parts.
        is_within_step = !taken.ends_step;
        if (is_within_step) return;
        keep(taken.after);
        if (++step < grid.segment_steps[segment]) return;
        step = 0;
        ++segment;
      });
      if (!alive) break;
      if (!after_round(static_cast<double>(grid.steps))) return std::nullopt;
    }
    return out;
  }

 private:
  static TileResult collect(const Study& study, const std::vector<PointResult>& points) {
    const std::size_t outputs = study.selection.output_count();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    TileResult result;
    result.outputs.resize(outputs * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PointResult& point = points[i];
      result.status.push_back(point.diverged ? STATUS_diverged : STATUS_ok);
      for (std::size_t j = 0; j < outputs; ++j) {
        Array2(result.outputs, points.size())[j][i] = point.diverged ? nan : point.outputs[j];
      }
      for (const double sample : point.samples) {
        result.samples.push_back(point.diverged ? nan : sample);
      }
      result.final_states.insert(result.final_states.end(), point.state.begin(), point.state.end());
    }
    return result;
  }
};

}  // namespace

std::unique_ptr<Engine> make_reference_engine() { return std::make_unique<ReferenceEngine>(); }

}  // namespace gearsweep
